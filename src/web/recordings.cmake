# Recordings of sound: libsndfile, with the libraries for FLAC, Ogg Vorbis and Ogg Opus, which it
# takes only together.
web_library(web_ogg libogg-* src/bitwise.c src/framing.c)

web_library(web_flac flac-* src/libFLAC/*.c)
get_target_property(sources web_flac SOURCES)
list(FILTER sources EXCLUDE REGEX "_(avx2|fma|neon|sse2|ssse3|sse41|vsx)\\.c$|metadata_iterators")
set_target_properties(web_flac PROPERTIES SOURCES "${sources}")
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/flac/config.h CONTENT "#define CPU_IS_BIG_ENDIAN 0
#define ENABLE_64_BIT_WORDS 0
#define FLAC__HAS_OGG 1
#define FLAC__NO_ASM
#define HAVE_BSWAP16
#define HAVE_BSWAP32
#define HAVE_FSEEKO
#define HAVE_LROUND 1
#define HAVE_STDINT_H 1
#define HAVE_STDLIB_H 1
#define HAVE_STRING_H 1
#define PACKAGE_VERSION \"1.4.2\"\n")
target_compile_definitions(web_flac PRIVATE HAVE_CONFIG_H)
target_include_directories(web_flac PRIVATE ${CMAKE_BINARY_DIR}/flac ${web_flac_folder}/src/libFLAC/include
  ${web_flac_folder}/include)

web_library(web_vorbis libvorbis-* lib/*.c)
get_target_property(sources web_vorbis SOURCES)
list(FILTER sources EXCLUDE REGEX "/(barkmel|psytune|tone|vorbisfile)\\.c$")
set_target_properties(web_vorbis PROPERTIES SOURCES "${sources}")
target_include_directories(web_vorbis PRIVATE ${web_vorbis_folder}/lib ${web_vorbis_folder}/include)

web_library(web_opus opus-* celt/*.c silk/*.c silk/float/*.c src/*.c)
get_target_property(sources web_opus SOURCES)
list(FILTER sources EXCLUDE REGEX "_demo|_compare|dump_modes")
set_target_properties(web_opus PROPERTIES SOURCES "${sources}")
target_compile_definitions(web_opus PRIVATE OPUS_BUILD VAR_ARRAYS FLOAT_APPROX HAVE_LRINT HAVE_LRINTF
  PACKAGE_VERSION="1.3.1")
target_include_directories(web_opus PRIVATE ${web_opus_folder}/include ${web_opus_folder}/celt
  ${web_opus_folder}/silk ${web_opus_folder}/silk/float)

# WAV, AIFF, AU and the like, and by the libraries above FLAC and Ogg.
web_library(web_sndfile libsndfile-* src/*.c src/ALAC/*.c src/G72x/g7*.c src/GSM610/*.c)
get_target_property(sources web_sndfile SOURCES)
list(FILTER sources EXCLUDE REGEX "windows\\.c|g72x_test|/new\\.c|id3_|gsm_test")
set_target_properties(web_sndfile PROPERTIES SOURCES "${sources}")
set(config)
foreach(have BYTESWAP_H ENDIAN_H FSTAT FSYNC FTRUNCATE GETTIMEOFDAY GMTIME GMTIME_R INTTYPES_H LIBM LOCALE_H
        LOCALTIME LOCALTIME_R LRINT LRINTF LROUND LSEEK MMAP OPEN PIPE READ SNPRINTF SSIZE_T STDBOOL_H
        STDINT_H STDLIB_H STRINGS_H STRING_H SYS_STAT_H SYS_TIME_H SYS_TYPES_H UNISTD_H VSNPRINTF WRITE)
  string(APPEND config "#define HAVE_${have} 1\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/sndfile/config.h @ONLY CONTENT "@config@#define COMPILER_IS_GCC 1
#define CPU_IS_LITTLE_ENDIAN 1
#define CPU_IS_BIG_ENDIAN 0
#define CPU_CLIPS_POSITIVE 0
#define CPU_CLIPS_NEGATIVE 0
#define HAVE_EXTERNAL_XIPH_LIBS 1
#define HAVE_MPEG 0
#define HAVE_IMMINTRIN_H 0
#define ENABLE_EXPERIMENTAL_CODE 0
#define OS_IS_WIN32 0
#define OS_IS_OPENBSD 0
#define USE_WINDOWS_API 0
#define WORDS_BIGENDIAN 0
#define SIZEOF_DOUBLE 8
#define SIZEOF_FLOAT 4
#define SIZEOF_INT 4
#define SIZEOF_INT64_T 8
#define SIZEOF_LONG 4
#define SIZEOF_LONG_LONG 8
#define SIZEOF_OFF_T 8
#define SIZEOF_SHORT 2
#define SIZEOF_SIZE_T 4
#define SIZEOF_SSIZE_T 4
#define SIZEOF_VOIDP 4
#define SIZEOF_WCHAR_T 4
#define PACKAGE \"libsndfile\"
#define PACKAGE_NAME \"libsndfile\"
#define PACKAGE_VERSION \"1.2.0\"
#define VERSION \"1.2.0\"\n")
target_include_directories(web_sndfile PRIVATE ${CMAKE_BINARY_DIR}/sndfile ${web_sndfile_folder}/src
  ${web_sndfile_folder}/include)
target_link_libraries(web_sndfile PRIVATE web_flac web_vorbis web_opus web_ogg)
add_library(PkgConfig::SNDFILE ALIAS web_sndfile)
