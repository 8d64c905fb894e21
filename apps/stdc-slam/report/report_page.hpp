#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace stdc::app {

/// A page that is complete in itself: data, style, scripts and the library of its plots in one HTML file,
/// which loads nothing. What it shows is in `document`, docs/report.md has the layout; "title" is there in
/// any case. Bytes that are no UTF-8 become replacement characters. The same document gives the same bytes.
std::string report_page(const nlohmann::ordered_json& document);

/// The document of a page that report_page() made. Throws Error naming `where` if it is none.
nlohmann::ordered_json report_document(std::string_view page, const std::string& where);

/// JSON as text, indented, for the files of results; bytes that are no UTF-8 become replacement characters.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace stdc::app
