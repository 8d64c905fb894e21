"""`pip install .` builds the C++ core and installs the package stdc_slam (needs the packages of scripts/packages.txt, and
pybind11-dev, python3-dev; python3-skbuild with --no-build-isolation)."""
import os

from skbuild import setup

setup(
    name="stdc-slam",
    version="0.1.0",
    description="RGB-D visual SLAM that keeps its accuracy when people and things move",
    license="Apache-2.0",
    packages=["stdc_slam"],
    package_dir={"": "python"},
    package_data={"stdc_slam": ["py.typed", "*.pyi"]},
    include_package_data=True,
    python_requires=">=3.9",
    install_requires=["numpy"],
    cmake_args=[
        "-GNinja",
        "-DCMAKE_BUILD_TYPE=Release",
        "-DSTDC_BUILD_PYTHON=ON",
        "-DCMAKE_POSITION_INDEPENDENT_CODE=ON",
        *(f"-DSTDC_{part}=OFF" for part in ("BUILD_PROGRAM", "BUILD_TESTS", "BUILD_SIMULATION", "BUILD_BENCHMARKS",
                                            "BUILD_TOOLS", "INSTALL")),
        *os.environ.get("STDC_CMAKE_ARGS", "").split(),
    ],
)
