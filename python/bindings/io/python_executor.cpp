// SPDX-License-Identifier: MIT
#include "io/python_executor.hpp"

#include <cstdint>
#include <string>

#include "interface/gil.hpp"
#include "interface/signals.hpp"
#include "io/io_parts.hpp"

namespace polhode::python {

namespace {

// Exceptions of C++ do not cross the frames of Python: they wait here.
class Ended {
 public:
  // Whether f() returned.
  template <class F>
  bool returns(const F& f) {
    const WithoutGil released;  // whoever hears of progress needs it
    try {
      f();
      return true;
    } catch (...) {
      thrown_ = std::current_exception();
      return false;
    }
  }
  void raise() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  std::exception_ptr thrown_;
};

}  // namespace

void PythonExecutor::run(ensemble::ExecutorWork&, const ensemble::ExecutorStage& stage,
                         const Take& take, const std::function<void()>& look) {
  Ended ended;
  {
    const WithGil acquired;
    try {
      staying_put([&] {
        const nb::object taker = nb::cpp_function([&](std::int64_t cell, const nb::bytes& bytes) {
          const std::string from(bytes.c_str(), bytes.size());
          return ended.returns([&] { take(cell, from); });
        });
        const nb::object is_stopped = nb::cpp_function([&] { return !ended.returns(look); });
        return nb::handle(function_)(nb::bytes(stage.bytes.data(), stage.bytes.size()), stage.first,
                                     stage.count, taker, is_stopped);
      });
    } catch (...) {
      failure_ = std::current_exception();
      failed_ = true;
    }
  }
  ended.raise();
  if (has_failed()) look();  // stops
}

void ExecutorLoop::do_work(const std::function<void()>& work) {
  try {
    loop_.do_work(work);
  } catch (const io::RunInterrupted&) {
    workers_.raise();  // what they have done is kept
    throw;
  }
}

namespace {

nb::bytes cell_of(const WorkerCells& of, std::int64_t index) {
  const Progress signals = signal_check();
  std::string bytes;
  {
    const WithoutGil released;
    bytes = of.work->cell(index, [&] {
      if (signals) signals(0.0);
    });
  }
  return nb::bytes(bytes.data(), bytes.size());
}

}  // namespace

void bind_executor_work(nb::module_& m) {
  nb::class_<WorkerCells>(m, "_ExecutorWork")
      .def(
          "begin",
          [](WorkerCells& of, const nb::bytes& stage) {
            of.work->begin(std::string(stage.c_str(), stage.size()));
          },
          "stage"_a)
      .def("cell", cell_of, "index"_a);
}

}  // namespace polhode::python
