#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace stdc::app {

/// What a file has to show side by side with others: a page that this program wrote, or results of evo_ape.
/// @param content  of the file
/// @param name     what its run is called if it does not say so itself
/// @param where    names the file in errors
nlohmann::ordered_json read_report(const std::string& content, const std::string& name,
                                   const std::string& where);

struct Comparison {
  std::string page;
  int runs = 0;
};

/// The page that shows all runs of the documents side by side. Throws Error if there are none or too many, or
/// if a document holds what this program does not write.
/// @param names    what the runs of each document are to be called
/// @param command  that made the page
Comparison compare_reports(const std::vector<std::string>& names,
                           std::vector<nlohmann::ordered_json> documents, const std::string& command);

}  // namespace stdc::app
