#pragma once

#include <cxxabi.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

namespace stdc::python {

/// While it lives other threads of Python run. As pybind11::gil_scoped_release, but a daemon thread that
/// comes back when the interpreter is ending stays where it is until the process is gone: Python would end it
/// by unwinding its stack, through functions that must not be left so, and the whole process would abort.
class ReleasedGil {
 public:
  ReleasedGil() : state_(PyEval_SaveThread()) {}
  ~ReleasedGil() {
    try {
      PyEval_RestoreThread(state_);
    } catch (abi::__forced_unwind&) {
      while (true) pause();
    }
  }
  ReleasedGil(const ReleasedGil&) = delete;
  ReleasedGil& operator=(const ReleasedGil&) = delete;

 private:
  PyThreadState* state_;
};

}  // namespace stdc::python
