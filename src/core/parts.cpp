#include "core/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "core/files.hpp"
#include "core/row_file.hpp"

namespace recoil {
namespace {

Json json_of(const Origin& origin) {
  return {
      {"command", origin.command}, {"folder", origin.folder},         {"version", origin.version},
      {"program", origin.program}, {"inputs", origin.inputs},         {"seed", origin.seed},
      {"pieces", origin.pieces},   {"arithmetic", origin.arithmetic}, {"start", origin.start}};
}

Origin origin_in(const Json& json) {
  Origin origin;
  json.at("command").get_to(origin.command);
  json.at("folder").get_to(origin.folder);
  json.at("version").get_to(origin.version);
  json.at("program").get_to(origin.program);
  json.at("inputs").get_to(origin.inputs);
  json.at("seed").get_to(origin.seed);
  json.at("pieces").get_to(origin.pieces);
  json.at("arithmetic").get_to(origin.arithmetic);
  json.at("start").get_to(origin.start);
  return origin;
}

}  // namespace

std::optional<OriginDifference> difference(const Origin& a, const Origin& b) {
  if (a.version != b.version) return OriginDifference::version;
  if (a.program != b.program) return OriginDifference::program;
  if (a.seed != b.seed) return OriginDifference::seed;
  if (a.command != b.command) return OriginDifference::command;
  if (a.pieces != b.pieces) return OriginDifference::pieces;
  if (a.inputs != b.inputs) return OriginDifference::inputs;
  if (a.arithmetic != b.arithmetic) return OriginDifference::arithmetic;
  if (a.start != b.start) return OriginDifference::start;
  return std::nullopt;
}

std::string key_of(const Origin& origin) {
  Json all = json_of(origin);
  all.erase("folder");
  return sha256_hex(all.dump());
}

std::filesystem::path part_path(const std::filesystem::path& folder, const Origin& origin,
                                const Shard& shard) {
  return folder / fmt::format("part-{}-of-{}-{}.jsonl", shard.number, shard.of,
                              key_of(origin).substr(0, 12));
}

Json part_head(const Origin& origin, const Shard& shard) {
  return {{"part", shard.number}, {"of", shard.of}, {"origin", json_of(origin)}};
}

std::optional<PartFile> part_in(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  if (!name.starts_with("part-") || !name.ends_with(".jsonl")) return std::nullopt;
  const std::optional<Json> head = read_row_head(file);
  if (!head) return std::nullopt;
  try {
    const auto shard = shard_named(fmt::format("{}/{}", head->at("part").get<std::size_t>(),
                                               head->at("of").get<std::size_t>()));
    if (!shard) return std::nullopt;
    return PartFile{file, origin_in(head->at("origin")), *shard};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

std::vector<PartFile> parts_in(const std::filesystem::path& folder) {
  std::vector<PartFile> parts;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
    if (auto part = part_in(entry.path())) parts.push_back(std::move(*part));
  }
  std::sort(parts.begin(), parts.end(), [](const PartFile& a, const PartFile& b) {
    return std::tie(a.shard.of, a.shard.number, a.file) <
           std::tie(b.shard.of, b.shard.number, b.file);
  });
  return parts;
}

std::vector<std::size_t> missing_shards(const std::vector<PartFile>& parts, std::size_t pieces,
                                        std::size_t of) {
  std::vector<bool> there(pieces);
  for (const PartFile& part : parts) {
    for (std::size_t i = part.shard.number - 1; i < pieces; i += part.shard.of) there[i] = true;
  }
  std::vector<std::size_t> missing;
  for (std::size_t number = 1; number <= of; ++number) {
    for (std::size_t i = number - 1; i < pieces; i += of) {
      if (there[i]) continue;
      missing.push_back(number);
      break;
    }
  }
  return missing;
}

}  // namespace recoil
