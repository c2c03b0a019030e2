#pragma once

#include <string>
#include <vector>

#include "document/document.hpp"

/// Documents as Markdown (GitHub's, with its tables), to be committed and read where they stand.
namespace recoil {

std::string markdown_of(const Sentence& sentence);
std::string markdown_of(const std::vector<Block>& blocks);
std::string markdown_page(const Document& document);

}  // namespace recoil
