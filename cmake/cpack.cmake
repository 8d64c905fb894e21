# Debian packages, one for each component: `cpack` in a build folder, or scripts/package, which builds and checks them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME stdc-slam)
set(CPACK_PACKAGE_VENDOR "STDC-SLAM")
# Who builds them maintains them, as with Debian's own tools: $DEBFULLNAME and $DEBEMAIL.
set(CPACK_PACKAGE_CONTACT "STDC-SLAM developers <stdc-slam@example.org>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL library dev program models)
if(STDC_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_STRIP_FILES ON)

set(soversion ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
# stdc_deb(COMPONENT NAME SUMMARY DEPENDS LINE...): the lines are the description
macro(stdc_deb component name summary depends)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}")
  string(REPLACE ";" "\n" text "${ARGN}")
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}\n${text}")
  install(FILES packaging/debian/copyright DESTINATION share/doc/${name} COMPONENT ${component})
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz DESTINATION share/doc/${name} COMPONENT ${component})
endmacro()
configure_file(packaging/debian/changelog.in changelog @ONLY)
execute_process(COMMAND gzip -9nc ${CMAKE_CURRENT_BINARY_DIR}/changelog
  OUTPUT_FILE ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz)

stdc_deb(library libstdc-slam${soversion} "RGB-D visual SLAM in dynamic scenes (library)" ""
  "Finds the trajectory of an RGB-D camera and a map of what it sees, in real"
  "time and without being misled by people and things that move.")
stdc_deb(dev libstdc-slam-dev "RGB-D visual SLAM in dynamic scenes (development files)"
  "libstdc-slam${soversion} (= ${PROJECT_VERSION}), libeigen3-dev, libopencv-core-dev"
  "Headers, CMake and pkg-config files of STDC-SLAM.")
stdc_deb(program stdc-slam "RGB-D visual SLAM in dynamic scenes (command line)" ""
  "Runs on recordings and live cameras, scores trajectories and looks into maps.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "stdc-slam-models")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg")  # started for inputs with a video, if it is there
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SUGGESTS "ffmpeg")
stdc_deb(models stdc-slam-models "RGB-D visual SLAM in dynamic scenes (network weights)" ""
  "Weights of the segmentation network. They were trained on data for research"
  "only, but for those called permissive: see their README.")
set(CPACK_DEBIAN_MODELS_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_MODELS_PACKAGE_SHLIBDEPS OFF)
if(STDC_BUILD_PYTHON)
  stdc_deb(python python3-stdc-slam "RGB-D visual SLAM in dynamic scenes (Python module)" "python3, python3-numpy"
    "import stdc_slam: frames in as numpy arrays, poses, masks and maps out.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "stdc-slam-models")
endif()
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/debian/triggers)
include(CPack)
