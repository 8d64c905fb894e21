# OpenCV's own package file is in the meta package of 1 GB (libopencv-dev); the small packages that this project
# asks for have only headers and libraries. Take the package file where it is, else make the targets here.
if(NOT STDC_OPENCV_MODULES)
  set(STDC_OPENCV_MODULES core imgproc)
endif()
find_package(OpenCV 4.5 CONFIG QUIET COMPONENTS ${STDC_OPENCV_MODULES})
if(NOT OpenCV_FOUND)
  find_path(OpenCV_INCLUDE_DIRS opencv2/core.hpp PATH_SUFFIXES opencv4)
  if(NOT OpenCV_INCLUDE_DIRS)
    message(FATAL_ERROR "OpenCV's headers are missing; run ./demo or: apt-get install $(cat scripts/packages.txt)")
  endif()
  foreach(module IN LISTS STDC_OPENCV_MODULES)
    find_library(OPENCV_${module}_LIBRARY opencv_${module} REQUIRED)
    add_library(opencv_${module} SHARED IMPORTED GLOBAL)
    set_target_properties(opencv_${module} PROPERTIES IMPORTED_LOCATION ${OPENCV_${module}_LIBRARY}
      INTERFACE_INCLUDE_DIRECTORIES ${OpenCV_INCLUDE_DIRS}
      INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${OpenCV_INCLUDE_DIRS})
  endforeach()
endif()
