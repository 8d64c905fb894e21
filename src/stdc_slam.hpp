#pragma once

// All that a program needs that tracks an RGB-D camera or a recording. Smaller includes are in the folders:
// slam/slam.hpp is the heart.

#include "core/error.hpp"
#include "dense/export/mesh_files.hpp"
#include "evaluation/trajectory_error.hpp"
#include "input/camera_file.hpp"
#include "input/frame_decoder.hpp"
#include "input/open_source.hpp"
#include "input/tum_calibration.hpp"
#include "slam/make_segmenter.hpp"
#include "slam/settings_io.hpp"
#include "slam/slam.hpp"
