#include "apps/explore/page_server.hpp"
#include "python/engine/python.hpp"

namespace arcwall::python {

void bind_exploring(py::module_& module) {
  // Serves until a signal asks for the end, or until the page is closed. The process has one thread.
  module.def(
      "explore",
      [](const std::string& text, const std::string& file, double seconds, const py::function& listening) {
        const py::gil_scoped_release released;
        explore::serve({.file = file, .text = text}, {.seconds = seconds}, [&](const std::string& address) {
          const py::gil_scoped_acquire held;
          listening(address);
        });
      },
      py::arg("text"), py::arg("file"), py::arg("seconds"), py::arg("listening"));
}

}  // namespace arcwall::python
