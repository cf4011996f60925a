// lamina for Python: what api/lamina/design.h offers, as plain tuples and
// arrays. lamina/__init__.py gives them names; that is what users see.
//
// Long calls release the interpreter's lock, and nothing in them calls Python:
// messages wait in a list. A design is read on a thread of its own, whose stack
// is as large as the program's: Python's threads may have very small ones.

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pthread.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "api/lamina/design.h"
#include "base/version.h"

namespace py = pybind11;

namespace lamina::python {
namespace {

// Address space; memory is taken as it is touched.
constexpr std::size_t kLargestStack = std::size_t{2} << 30;
constexpr std::size_t kSmallestStack = std::size_t{8} << 20;
// Of it, for what is not evaluation.
constexpr std::size_t kOtherStack = std::size_t{2} << 20;

// Runs `work` with the size of the stack that evaluation may use, and throws
// what it throws.
void run_on_large_stack(const std::function<void(std::size_t)>& work) {
  struct Task {
    const std::function<void(std::size_t)>& work;
    std::size_t size;
    std::exception_ptr fault;
  } task{work, kLargestStack, nullptr};
  const auto run = [](void* given) -> void* {
    auto& its = *static_cast<Task*>(given);
    try {
      its.work(its.size - kOtherStack);
    } catch (...) {
      its.fault = std::current_exception();
    }
    return nullptr;
  };
  pthread_attr_t attributes;
  if (::pthread_attr_init(&attributes) != 0) throw std::bad_alloc();
  pthread_t thread{};
  int status = 0;
  do {
    ::pthread_attr_setstacksize(&attributes, task.size);
    status = ::pthread_create(&thread, &attributes, run, &task);
  } while (status != 0 && (task.size /= 2) >= kSmallestStack);
  ::pthread_attr_destroy(&attributes);
  if (status != 0) throw std::bad_alloc();
  ::pthread_join(thread, nullptr);
  if (task.fault) std::rethrow_exception(task.fault);
}

// What a design echoed and was warned of, each text once, however often it is
// sliced.
class Messages {
 public:
  void add(std::string_view text) {
    const std::lock_guard lock(mutex_);
    if (std::ranges::find(texts_, text) == texts_.end()) {
      texts_.emplace_back(text);
    }
  }
  std::vector<std::string> texts() const {
    const std::lock_guard lock(mutex_);
    return texts_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> texts_;
};

// A design with its messages.
class Solid {
 public:
  using Make = std::function<Design(const DesignOptions&)>;

  Solid(DesignOptions options, const Make& make) {
    options.show = [messages = messages_](std::string_view text) {
      messages->add(text);
    };
    run_on_large_stack([&](std::size_t stack) {
      options.stack = stack;
      design_ = std::make_unique<Design>(make(options));
    });
  }

  // Its messages are those of both.
  Solid(const Solid& other, const ParameterValues& values)
      : messages_(other.messages_) {
    run_on_large_stack([&](std::size_t) {
      design_ = std::make_unique<Design>(other.design_->with(values));
    });
  }

  const Design& design() const { return *design_; }
  std::vector<std::string> messages() const { return messages_->texts(); }

 private:
  std::shared_ptr<Messages> messages_ = std::make_shared<Messages>();
  std::unique_ptr<Design> design_;
};

DesignOptions design_options(const py::dict& given) {
  DesignOptions options;
  const auto take = [&](const char* name, auto& value) {
    if (!given.contains(name)) return;
    value = given[name].cast<std::decay_t<decltype(value)>>();
  };
  take("definitions", options.definitions);
  take("parameter_file", options.parameter_file);
  take("parameter_set", options.parameter_set);
  take("values", options.values);
  take("chordal_error", options.chordal_error);
  take("scale", options.scale);
  take("axis", options.axis);
  take("place_on_bed", options.place_on_bed);
  take("supports", options.supports);
  take("raft", options.has_raft);
  take("sprue", options.has_sprue);
  take("hollow", options.hollow);
  take("layer", options.layer_thickness);
  take("printer", options.printer);
  take("material", options.material);
  take("metal", options.metal);
  take("prices", options.prices);
  take("language", options.language);
  take("seed", options.seed);
  take("max_depth", options.max_depth);
  take("max_leaves", options.max_leaves);
  take("root", options.root);
  take("readable", options.readable);
  take("no_import", options.no_import);
  take("module_folder", options.module_folder);
  return options;
}

// Its points as an n × 2 array, which holds on to the layer.
py::array to_array(const Loop& loop, const py::handle& layer) {
  static_assert(sizeof(Point) == 2 * sizeof(double));
  const auto count = static_cast<py::ssize_t>(loop.size());
  py::array_t<double> points({count, py::ssize_t{2}},
                             reinterpret_cast<const double*>(loop.data()),
                             layer);
  py::detail::array_proxy(points.ptr())->flags &=
      ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return points;
}

py::tuple loops_of(const py::object& self) {
  const auto& layer = self.cast<const Layer&>();
  py::tuple loops(layer.loops.size());
  for (std::size_t i = 0; i < layer.loops.size(); ++i) {
    loops[i] = to_array(layer.loops[i], self);
  }
  return loops;
}

// Layers one by one, so that one that is kept keeps no others.
py::list slice(const Solid& solid, const SliceOptions& options) {
  std::vector<std::shared_ptr<Layer>> layers;
  {
    const py::gil_scoped_release released;
    for (Layer& layer : solid.design().slice(options)) {
      layers.push_back(std::make_shared<Layer>(std::move(layer)));
    }
  }
  py::list list(layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    list[i] = py::cast(std::move(layers[i]));
  }
  return list;
}

py::tuple to_tuple(const ThinPlace& thin) {
  return py::make_tuple(thin.is_wall ? "wall" : "gap", thin.width, thin.place.x,
                        thin.place.y, thin.z, thin.bottom, thin.top,
                        thin.source_line);
}

py::tuple to_tuple(const Finding& found) {
  constexpr const char* kKinds[] = {"island", "loose part", "overhang",
                                    "suction cup", "resin trap"};
  return py::make_tuple(kKinds[static_cast<std::size_t>(found.kind)],
                        found.is_minor, found.first_layer, found.last_layer,
                        found.bottom, found.top, found.place.x, found.place.y,
                        found.z, found.area, found.volume, found.distance,
                        found.source_line);
}

py::tuple to_tuple(const Support& support) {
  return py::make_tuple(support.contact.x, support.contact.y, support.z,
                        support.tip, support.is_on_bed, support.source_line);
}

py::tuple to_tuple(const Parameter& parameter) {
  return py::make_tuple(parameter.name, parameter.value, parameter.choices,
                        parameter.description, parameter.group);
}

py::tuple to_tuple(const Inspection::Row& row) {
  return py::make_tuple(row.bottom, row.thickness, row.loops, row.holes,
                        row.vertices, row.area, row.perimeter);
}

py::tuple to_tuple(const Remark& remark) {
  return py::make_tuple(remark.message, remark.file, remark.line,
                        remark.column);
}

template <typename Rows>
py::list to_list(const Rows& rows) {
  py::list list;
  for (const auto& row : rows) list.append(to_tuple(row));
  return list;
}

py::tuple to_tuple(const Inspection& all) {
  return py::make_tuple(all.format, all.writer, to_list(all.layers), all.volume,
                        all.defects, all.reported_defects,
                        to_list(all.thin_places), to_list(all.findings));
}

// What `work` returns, while other threads of Python run.
template <typename Work>
auto released(const Work& work) {
  const py::gil_scoped_release unlocked;
  return work();
}

// Design::from_file() and the like, with the class of exceptions.
void define_design(py::module_& module) {
  py::class_<Solid>(module, "Solid")
      .def(py::init([](const std::string& path, const py::object& text,
                       const py::dict& given) {
        const DesignOptions options = design_options(given);
        Solid::Make make = [&path](const DesignOptions& its) {
          return Design::from_file(path, its);
        };
        if (!text.is_none()) {
          make = [&path,
                  whole = text.cast<std::string>()](const DesignOptions& its) {
            return Design::from_text(whole, its, path);
          };
        }
        return released([&] { return std::make_unique<Solid>(options, make); });
      }))
      .def("with_values",
           [](const Solid& solid, const ParameterValues& values) {
             return released(
                 [&] { return std::make_unique<Solid>(solid, values); });
           })
      .def("slice", &slice)
      .def("write",
           [](const Solid& solid, const std::string& path,
              const SliceOptions& options, const std::string& printer,
              const std::string& mirror) {
             const auto turns = [&](char axis) {
               return mirror.find(axis) != std::string::npos;
             };
             released([&] {
               solid.design().write(path, options,
                                    {printer, turns('x'), turns('y')});
             });
           })
      .def("thin_places",
           [](const Solid& solid, double width, const SliceOptions& options) {
             return to_list(released([&] {
               return solid.design().find_thin_places(width, options);
             }));
           })
      .def("check",
           [](const Solid& solid, const SliceOptions& options,
              double self_supporting) {
             return to_list(released([&] {
               return solid.design().check(options, self_supporting);
             }));
           })
      .def("report",
           [](const Solid& solid, const SliceOptions& options,
              double self_supporting, double min_feature) {
             return released([&] {
               return solid.design().report(options,
                                            {self_supporting, min_feature});
             });
           })
      .def("page",
           [](const Solid& solid, const SliceOptions& options) {
             return released([&] { return solid.design().page(options); });
           })
      .def("parameters",
           [](const Solid& solid) {
             return to_list(solid.design().parameters());
           })
      .def(
          "supports",
          [](const Solid& solid) { return to_list(solid.design().supports()); })
      .def("messages", &Solid::messages);
}

void define_layer(py::module_& module) {
  py::class_<Layer, std::shared_ptr<Layer>>(
      module, "Layer", "A layer; `loops` share its memory and keep it alive.")
      .def_readonly("z", &Layer::section_z, "height of the section [mm]")
      .def_readonly("bottom", &Layer::bottom, "its lower side [mm]")
      .def_readonly("top", &Layer::top, "its upper side [mm]")
      .def_property_readonly(
          "loops", &loops_of,
          "n × 2 arrays [mm], read-only: outer loops anticlockwise, holes "
          "clockwise")
      .def_property_readonly(
          "area", [](const Layer& layer) { return area(layer); },
          "of what is solid [mm²]")
      .def(
          "to_shapely",
          [](const py::object& self) {
            return py::module_::import("lamina._shapely")
                .attr("polygons_of")(self);
          },
          "The layer as a shapely MultiPolygon; needs shapely.")
      .def("__repr__", [](const Layer& layer) {
        return py::str("<lamina.Layer z={:g}, {} loops>")
            .format(layer.section_z, layer.loops.size());
      });
}

void define_error(py::module_& module) {
  // lamina.Error is a class of Python, which holds the place.
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(std::move(thrown));
    } catch (const DesignError& error) {
      const py::object type =
          py::module_::import("lamina._records").attr("Error");
      const py::object raised =
          type(error.what(), to_tuple(error.fault), to_list(error.calls));
      PyErr_SetObject(type.ptr(), raised.ptr());
    }
  });
  module.attr("version") = std::string(version());
}

}  // namespace

PYBIND11_MODULE(_lamina, module) {
  py::class_<SliceOptions>(module, "SliceOptions")
      .def(py::init([](double layer, double adaptive, double max_layer,
                       std::vector<double> heights, double tolerance,
                       double compensation, unsigned threads) {
        return SliceOptions{layer,     adaptive,     max_layer, heights,
                            tolerance, compensation, threads};
      }));
  define_layer(module);
  define_design(module);
  define_error(module);
  module.def("inspect", [](const std::string& path, double self_supporting,
                           double min_feature) {
    return to_tuple(released([&] {
      return inspect_file(path, {self_supporting, min_feature});
    }));
  });
}

}  // namespace lamina::python
