#include <fmt/format.h>

#include <filesystem>

#include "bindings.hpp"
#include "core/error.hpp"
#include "slam/settings_io.hpp"

namespace stdc::python {

void bind_errors(py::module_& module) {
  static py::exception<Error> type(module, "Error", PyExc_ValueError);
  type.attr("__doc__") =
      "Bad input. str(error) is one line: where, problem and hint, which are attributes, too.";
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const Error& error) {
      py::object instance = static_cast<const py::object&>(type)(error.what());
      instance.attr("where") = error.where();
      instance.attr("problem") = error.problem();
      instance.attr("hint") = error.hint();
      PyErr_SetObject(type.ptr(), instance.ptr());
    }
  });
}

std::string path_of(const py::handle& object) {
  return py::module_::import("os").attr("fspath")(object).cast<std::string>();
}

namespace {

/// As YAML and --set spell it.
std::string value_text(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  return std::string(py::str(value));
}

void apply_dict(const py::dict& dict, Settings& settings) {
  for (const auto& [key, value] : dict) {
    const std::string name = std::string(py::str(key));
    if (!py::isinstance<py::dict>(value)) {
      apply_setting(fmt::format("{}={}", name, value_text(value)), settings);
      continue;
    }
    for (const auto& [field, item] : py::reinterpret_borrow<py::dict>(value))
      apply_setting(fmt::format("{}.{}={}", name, std::string(py::str(field)), value_text(item)), settings);
  }
}

}  // namespace

Settings settings_of(const py::handle& object) {
  Settings settings;
  if (object.is_none()) return settings;
  if (py::isinstance<py::dict>(object)) {
    apply_dict(py::reinterpret_borrow<py::dict>(object), settings);
  } else if (py::isinstance<py::str>(object) && object.cast<std::string>().find(':') != std::string::npos &&
             !std::filesystem::exists(object.cast<std::string>())) {
    parse_settings(object.cast<std::string>(), "settings", settings);
  } else {
    read_settings(path_of(object), settings);
  }
  settings.validate();
  return settings;
}

}  // namespace stdc::python
