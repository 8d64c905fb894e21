#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace stdc::app {

/// One group with the runs of the documents of several pages, in order. Of the sample frames those stay that
/// several runs have; names that are not unique get a number.
/// @param names  what the runs of each document are to be called
nlohmann::ordered_json merge_reports(const std::vector<std::string>& names,
                                     std::vector<nlohmann::ordered_json> documents);

/// The page of a document, at most `max_bytes` long: runs of a page with many of them get fewer pictures and
/// points. What cannot be left out may be longer.
std::string bounded_report_page(nlohmann::ordered_json document, std::size_t max_bytes = 3'000'000);

}  // namespace stdc::app
