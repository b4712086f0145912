#include "model/version.hpp"
#include "python/engine/python.hpp"

namespace arcwall::python {

namespace {

py::object error_class(const char* name) { return py::module_::import("arcwall.errors").attr(name); }

void set_error(const char* name, const py::object& argument) {
  const py::object type = error_class(name);
  PyErr_SetObject(type.ptr(), type(argument).ptr());
}

// What the program would do by an option.
std::string in_terms_of_python(std::string text) {
  const auto replace = [&text](const std::string& option, const std::string& by) {
    if (const std::size_t at = text.find(option); at != std::string::npos) text.replace(at, option.size(), by);
  };
  replace(" with --out", "");
  replace("with --force", "with force=True");
  return text;
}

// The libraries' errors as those of Python.
void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    set_error("DeckError", to_python(error.diagnostics()));
  } catch (const OutputError& error) {
    set_error("FileError", py::str(in_terms_of_python(error.what())));
  }
}

}  // namespace

void raise(const char* name, const std::string& text) {
  set_error(name, py::str(text));
  throw py::error_already_set();
}

py::object to_python(const nlohmann::ordered_json& json) {
  using Kind = nlohmann::ordered_json::value_t;
  switch (json.type()) {
    case Kind::boolean:
      return py::bool_(json.get<bool>());
    case Kind::number_integer:
    case Kind::number_unsigned:
      return py::int_(json.get<std::int64_t>());
    case Kind::number_float:
      return py::float_(json.get<double>());
    case Kind::string: {
      const std::string& text = json.get_ref<const std::string&>();
      return py::reinterpret_steal<py::object>(
          PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
    }
    case Kind::array: {
      py::list list;
      for (const auto& item : json) list.append(to_python(item));
      return list;
    }
    case Kind::object: {
      py::dict dict;
      for (const auto& [key, item] : json.items()) dict[py::str(key)] = to_python(item);
      return dict;
    }
    case Kind::null:
    case Kind::binary:
    case Kind::discarded:
      break;
  }
  return py::none();
}

py::list to_python(const std::vector<Diagnostic>& diagnostics) {
  const py::object type = error_class("Diagnostic");
  py::list list;
  for (const Diagnostic& one : diagnostics)
    list.append(type(one.file, one.line, one.column, one.key, one.message, one.cure, to_text(one)));
  return list;
}

}  // namespace arcwall::python

PYBIND11_MODULE(_engine, module) {
  module.doc() = "The libraries of arcwall; use the package arcwall, which is made of it.";
  module.attr("version") = arcwall::program_version();
  pybind11::register_exception_translator(arcwall::python::translate);
  arcwall::python::bind_answers(module);
  arcwall::python::bind_decks(module);
  arcwall::python::bind_exploring(module);
  arcwall::python::bind_runs(module);
  arcwall::python::bind_systems(module);
}
