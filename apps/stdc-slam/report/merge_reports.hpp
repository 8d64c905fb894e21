#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace stdc::app {

/// The document of a page, and what its runs are to be called.
struct NamedReport {
  std::string name;
  nlohmann::ordered_json document;
};

/// One group with the runs of all of them, in order. Of the sample frames those stay that several runs have;
/// names that are not unique get a number.
nlohmann::ordered_json merge_reports(std::vector<NamedReport> reports);

/// The page of a document, at most `max_bytes` long: runs of a page with many of them get fewer pictures and
/// points. What cannot be left out may be longer.
std::string bounded_report_page(nlohmann::ordered_json document, std::size_t max_bytes = 3'000'000);

}  // namespace stdc::app
