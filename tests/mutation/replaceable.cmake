# Read after project() when mutate.py configures: every function of src is called by its name, also
# from its own object, so that the object of one changed source takes the place of the original when
# it is linked first. Little optimisation: what is compiled here runs once.
function(recoil_replaceable)
  foreach(target recoil_estimator recoil_library recoil_truth recoil_rest recoil recoil_commands recoil_study
      recoil_studies recoil_synthetic)
    target_compile_options(${target} PRIVATE -O1 -fPIC -fsemantic-interposition -w)
  endforeach()
endfunction()
cmake_language(DEFER DIRECTORY ${CMAKE_SOURCE_DIR} CALL recoil_replaceable)
