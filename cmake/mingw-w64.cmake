# Windows on x86-64, with Debian's g++-mingw-w64-x86-64-posix; wine runs what was built.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
# Windows aligns stacks to 16 bytes, but GCC spills 32-byte registers there as if aligned to 32 (GCC's
# bug 54412), which crashes now and then.
set(CMAKE_C_FLAGS_INIT "-Wa,-muse-unaligned-vector-move")
# Several sources at a time have more sections than the usual form of object files.
set(CMAKE_CXX_FLAGS_INIT "-Wa,-muse-unaligned-vector-move,-mbig-obj")
# What is built needs Windows alone.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
# Libraries and headers are those of Debian's packages for mingw-w64; Eigen, headers alone, is the
# system's, and mingw-w64-packages.cmake has more of that kind.
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(ZLIB_USE_STATIC_LIBS ON)
