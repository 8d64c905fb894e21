#pragma once

#include <string>
#include <vector>

#include "input/survey/input_survey.hpp"

namespace stdc::app {

/// "tum (folder in TUM RGB-D layout...)": a kind of inputs with its title.
std::string title_of_kind(const std::string& name);
/// What an input is, in lines for the terminal, the warnings last.
std::string info_text(const InputSurvey& survey, const std::vector<std::string>& warnings);
/// The same as JSON; null where nothing is known.
std::string info_json(const InputSurvey& survey, const std::vector<std::string>& warnings);

}  // namespace stdc::app
