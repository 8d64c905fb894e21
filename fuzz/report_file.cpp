// What `report` puts side by side: pages of this program, and archives of evo.
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.hpp"
#include "report/comparison.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string content(reinterpret_cast<const char*>(data), size);
  try {
    const nlohmann::ordered_json document = stdc::app::read_report(content, "input", "input");
    stdc::app::compare_reports({"a"}, {document}, "report");
    stdc::app::compare_reports({"a", "b"}, {document, document}, "report");
  } catch (const stdc::Error&) {
  }
  return 0;
}
