// info and convert as a user sees them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "commands/test_command_line.hpp"
#include "core/text_file.hpp"
#include "run/test_sequence.hpp"

namespace stdc::app {
namespace {

using stdc::test::TestFolder;

