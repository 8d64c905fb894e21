# Cross-compiles for 64-bit ARM: g++-aarch64-linux-gnu with Debian's arm64 packages unpacked in a folder, which scripts/arm64
# makes:   cmake -S . -B build/arm64 -DCMAKE_TOOLCHAIN_FILE=cmake/arm64.cmake -DSTDC_ARM64_ROOT=FOLDER
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

set(STDC_ARM64_ROOT "$ENV{STDC_ARM64_ROOT}" CACHE PATH "Debian's arm64 packages, unpacked")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES STDC_ARM64_ROOT)
set(CMAKE_SYSROOT ${STDC_ARM64_ROOT})
set(CMAKE_FIND_ROOT_PATH ${STDC_ARM64_ROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_LIBDIR} ${STDC_ARM64_ROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${STDC_ARM64_ROOT}/usr/share/pkgconfig)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${STDC_ARM64_ROOT})

find_program(STDC_QEMU qemu-aarch64-static REQUIRED)  # where it is: a test takes the PATH away
set(CMAKE_CROSSCOMPILING_EMULATOR ${STDC_QEMU} -L ${STDC_ARM64_ROOT})
