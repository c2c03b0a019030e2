# The libraries of recoil for WebAssembly, from Debian's sources (`./run web` unpacks them into
# RECOIL_WEB_SOURCES), with Debian's own headers. Only what the program calls is compiled.
set(RECOIL_WEB_SOURCES ${CMAKE_BINARY_DIR}/sources CACHE PATH "where apt-get source unpacked the sources")
set(linked ${CMAKE_BINARY_DIR}/include)  # headers of /usr/include that do not belong to the system

file(MAKE_DIRECTORY ${linked})
foreach(header cvodes FLAC fmt gsl md5.h nlohmann nvector ogg opus pugiconfig.hpp pugixml.hpp Random123 sha1.h
        sha2.h sndfile.h sundials sunlinsol sunmatrix sunmemory sunnonlinsol toml++ vorbis zip.h zipconf.h CLI)
  file(CREATE_LINK /usr/include/${header} ${linked}/${header} SYMBOLIC)
endforeach()
include_directories(SYSTEM ${linked})

# web_library(TARGET FOLDER SOURCE...): a library of the sources in FOLDER (both may be patterns),
# without tests; sets TARGET_folder.
function(web_library target pattern)
  file(GLOB folder ${RECOIL_WEB_SOURCES}/${pattern})
  if(NOT folder)
    message(FATAL_ERROR "${RECOIL_WEB_SOURCES} has no ${pattern}; start with ./run web")
  endif()
  set(sources)
  foreach(name ${ARGN})
    file(GLOB found ${folder}/${name})
    list(APPEND sources ${found})
  endforeach()
  list(FILTER sources EXCLUDE REGEX "test[^/]*$|benchmark|_main|/fake_|cuda")
  add_library(${target} STATIC EXCLUDE_FROM_ALL ${sources})
  # clang 15 vectorises a loop of libvorbis (mdct.c) into one that gives other numbers.
  target_compile_options(${target} PRIVATE -w $<$<COMPILE_LANGUAGE:C>:-fno-vectorize>)
  set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
  set(${target}_folder ${folder} PARENT_SCOPE)
endfunction()

add_library(Eigen3::Eigen INTERFACE IMPORTED)
set_target_properties(Eigen3::Eigen PROPERTIES INTERFACE_INCLUDE_DIRECTORIES /usr/include/eigen3
  INTERFACE_SYSTEM_INCLUDE_DIRECTORIES /usr/include/eigen3)
foreach(headers CLI11::CLI11 nlohmann_json::nlohmann_json tomlplusplus::tomlplusplus GSL::gslcblas
        SUNDIALS::nvecserial)
  add_library(${headers} INTERFACE IMPORTED)
endforeach()

# Ceres solves dense problems on one thread here.
web_library(web_ceres ceres-solver-* internal/ceres/*.cc internal/ceres/generated/*_d_d_d.cc
  internal/ceres/miniglog/glog/logging.cc)
set(config)
foreach(without LAPACK SUITESPARSE CXSPARSE CUDA ACCELERATE_SPARSE THREADS)
  string(APPEND config "#define CERES_NO_${without}\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/ceres/ceres/internal/config.h @ONLY CONTENT
  "#pragma once\n@config@#define CERES_NO_SPARSE\n#define CERES_RESTRICT_SCHUR_SPECIALIZATION\n")
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/ceres/ceres/internal/export.h CONTENT
  "#pragma once\n#define CERES_EXPORT\n#define CERES_NO_EXPORT\n#define CERES_DEPRECATED\n")
# The small log that Ceres brings has no level that could be set while it runs.
#pragma
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/ceres/glog/logging.h CONTENT "#pragma once
#include_next <glog/logging.h>
inline int FLAGS_minloglevel = 0;
namespace google {
constexpr int GLOG_FATAL = 3;
}\n")
target_include_directories(web_ceres SYSTEM BEFORE PUBLIC ${CMAKE_BINARY_DIR}/ceres
  ${web_ceres_folder}/include ${web_ceres_folder}/internal/ceres/miniglog PRIVATE ${web_ceres_folder}/internal)
target_compile_definitions(web_ceres PUBLIC MAX_LOG_LEVEL=-4)
set_target_properties(web_ceres PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 20)
# These define Eigen's macros otherwise, or a header without a guard defines something twice.
file(GLOB specialised ${web_ceres_folder}/internal/ceres/generated/*.cc
  ${web_ceres_folder}/internal/ceres/gradient_problem.cc ${web_ceres_folder}/internal/ceres/problem_impl.cc)
set_source_files_properties(${specialised} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
target_link_libraries(web_ceres PUBLIC Eigen3::Eigen)
add_library(Ceres::ceres ALIAS web_ceres)

# GSL wants a config.h from its configure script, and its sources by the side of its headers.
web_library(web_gsl gsl-2* cdf/[b-z]*.c err/error.c err/stream.c err/message.c err/strerror.c
  integration/glfixed.c ode-initval2/driver.c ode-initval2/evolve.c ode-initval2/control.c
  ode-initval2/cstd.c ode-initval2/cscal.c ode-initval2/step.c ode-initval2/rk8pd.c interpolation/accel.c interpolation/interp.c interpolation/spline.c
  interpolation/steffen.c interpolation/inline.c randist/gauss.c randist/tdist.c randist/gamma.c
  randist/chisq.c randist/exponential.c randist/gausszig.c rng/rng.c rng/inline.c roots/brent.c
  roots/convergence.c roots/fsolver.c specfunc/erfc.c specfunc/exp.c specfunc/expint.c
  specfunc/gamma.c specfunc/gamma_inc.c specfunc/log.c specfunc/psi.c specfunc/trig.c
  specfunc/zeta.c specfunc/elementary.c specfunc/beta.c specfunc/beta_inc.c specfunc/pow_int.c
  sys/minmax.c sys/prec.c sys/hypot.c sys/log1p.c sys/expm1.c sys/coerce.c sys/invhyp.c
  sys/pow_int.c sys/infnan.c sys/fdiv.c sys/fcmp.c sys/ldfrexp.c)
get_target_property(sources web_gsl SOURCES)
list(FILTER sources EXCLUDE REGEX "/cdf/beta_inc") # a part of cdf/beta.c
set_target_properties(web_gsl PROPERTIES SOURCES "${sources}")
set(config)
foreach(have DECL_ISINF DECL_ISNAN DECL_ISFINITE DECL_FINITE DECL_HYPOT DECL_EXPM1 DECL_LOG1P
        DECL_ACOSH DECL_ASINH DECL_ATANH DECL_LDEXP DECL_FREXP INLINE C99_INLINE IEEE_COMPARISONS
        IEEE_DENORMALS PRINTF_LONGDOUBLE VPRINTF STRDUP STRTOL STRTOUL MEMCPY MEMMOVE)
  string(APPEND config "#define HAVE_${have} 1\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/gsl/config.h @ONLY CONTENT
  "@config@#define GSL_COERCE_DBL(x) (x)
#define RETURN_IF_NULL(x) if (!x) { return; }
#define GSL_RANGE_CHECK 0
#define RELEASED 1\n")
target_include_directories(web_gsl PRIVATE ${CMAKE_BINARY_DIR}/gsl ${web_gsl_folder})
add_library(GSL::gsl ALIAS web_gsl)

web_library(web_cvodes sundials-* src/cvodes/cvode*.c src/sundials/*.c src/nvector/serial/nvector_serial.c
  src/sunnonlinsol/fixedpoint/sunnonlinsol_fixedpoint.c src/sunnonlinsol/newton/sunnonlinsol_newton.c)
get_target_property(sources web_cvodes SOURCES)
list(FILTER sources EXCLUDE REGEX "profiler|xbraid|fmod|cvodes_(ba|sp)")
set_target_properties(web_cvodes PROPERTIES SOURCES "${sources}")
target_include_directories(web_cvodes PRIVATE ${web_cvodes_folder}/include ${web_cvodes_folder}/src/sundials ${web_cvodes_folder}/src)
add_library(SUNDIALS::cvodes ALIAS web_cvodes)

web_library(web_fmt fmtlib-* src/format.cc src/os.cc)
add_library(fmt::fmt ALIAS web_fmt)

# SHA. Its sources need a declaration of lseek that they only include where configure found it.
web_library(web_md libmd-* src/md5.c src/md5hl.c src/sha1.c src/sha1hl.c src/sha2.c src/sha256hl.c
  src/sha512hl.c)
target_compile_options(web_md PRIVATE -include unistd.h)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/md/config.h CONTENT "#define HAVE_STDINT_H 1\n")
target_include_directories(web_md PRIVATE ${CMAKE_BINARY_DIR}/md ${web_md_folder}/include ${web_md_folder}/src)
add_library(PkgConfig::MD ALIAS web_md)

web_library(web_pugixml pugixml-* src/pugixml.cpp)
add_library(pugixml::pugixml ALIAS web_pugixml)

web_library(web_z zlib-* *.c)
target_include_directories(web_z PUBLIC ${web_z_folder})
target_compile_definitions(web_z PRIVATE HAVE_UNISTD_H)

# Workbooks are compressed by deflate and not encrypted.
web_library(web_zip libzip-* lib/zip_*.c)
get_target_property(sources web_zip SOURCES)
list(FILTER sources EXCLUDE REGEX "win32|uwp|winzip|crypto_win|commoncrypto|gnutls|mbedtls|openssl|bzip2|_xz")
file(STRINGS ${web_zip_folder}/lib/zip.h errors REGEX "^#define ZIP_ER_[A-Z_]+ [0-9]+ +/\\* [NSZ] .* \\*/")
set(words)
set(kinds)
foreach(line ${errors})
  string(REGEX MATCH "/\\* ([NSZ]) (.*) \\*/" comment "${line}")
  string(APPEND words "  \"${CMAKE_MATCH_2}\",\n")
  string(APPEND kinds "${CMAKE_MATCH_1}, ")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/zip/zip_err_str.c @ONLY CONTENT "#include \"zipint.h\"
#define N ZIP_ET_NONE
#define S ZIP_ET_SYS
#define Z ZIP_ET_ZLIB
const char* const _zip_err_str[] = {\n@words@};
const int _zip_nerr_str = sizeof(_zip_err_str) / sizeof(_zip_err_str[0]);
const int _zip_err_type[] = {@kinds@};\n")
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/zip/config.h CONTENT "#define HAVE_FILENO
#define HAVE_FSEEKO
#define HAVE_FTELLO
#define HAVE_LOCALTIME_R
#define HAVE_MKSTEMP
#define HAVE_SNPRINTF
#define HAVE_STRCASECMP
#define HAVE_STRDUP
#define HAVE_STRTOLL
#define HAVE_STRTOULL
#define HAVE_STDBOOL_H
#define HAVE_STRINGS_H
#define HAVE_UNISTD_H
#define HAVE_DIRENT_H
#define SIZEOF_OFF_T 8
#define SIZEOF_SIZE_T 4
#define PACKAGE \"libzip\"
#define VERSION \"\"\n")
set_target_properties(web_zip PROPERTIES SOURCES "${sources};${CMAKE_BINARY_DIR}/zip/zip_err_str.c")
target_compile_definitions(web_zip PRIVATE HAVE_CONFIG_H)
target_include_directories(web_zip PRIVATE ${CMAKE_BINARY_DIR}/zip ${web_zip_folder}/lib)
target_link_libraries(web_zip PRIVATE web_z)
add_library(PkgConfig::ZIP ALIAS web_zip)

include(${CMAKE_CURRENT_LIST_DIR}/recordings.cmake)

# One thread: pages opened as a file have no others.
foreach(header blocked_range enumerable_thread_specific global_control parallel_for task_arena)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/tbb/tbb/${header}.h CONTENT "#include \"web/one_thread.hpp\"\n")
endforeach()
add_library(web_tbb INTERFACE)
target_include_directories(web_tbb INTERFACE ${CMAKE_BINARY_DIR}/tbb ${PROJECT_SOURCE_DIR}/src)
add_library(TBB::tbb ALIAS web_tbb)

# Every source of recoil's own begins with what its standard library lacks.
add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:-include ${CMAKE_CURRENT_LIST_DIR}/standard.hpp>")
