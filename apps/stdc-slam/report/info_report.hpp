#pragma once

#include <string>
#include <vector>

#include "input/survey/input_survey.hpp"

namespace stdc::app {

/// What an input is, in lines for the terminal, the warnings last.
std::string info_text(const InputSurvey& survey, const std::vector<std::string>& warnings);
/// The same as JSON; null where nothing is known.
std::string info_json(const InputSurvey& survey, const std::vector<std::string>& warnings);

}  // namespace stdc::app
