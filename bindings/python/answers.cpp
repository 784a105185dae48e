// bindings/python/answers.cpp: foretouch.Step and Steps.
#include "bindings/python/answers.h"

#include <algorithm>
#include <array>
#include <utility>

#include "bindings/python/arguments.h"
#include "bindings/python/bindings.h"
#include "middleware/contact.h"
#include "middleware/events/told_depth.h"

namespace foretouch::python {
namespace {

using Eigen::Vector3d;

constexpr auto kContactBytes = static_cast<py::ssize_t>(sizeof(LinkContact));

// ---- arrays over links, and over steps and links ----

const LinkContact* firstOf(const Step& step) {
  return step.answers->contacts.data() + step.step * step.answers->links();
}
const LinkContact* firstOf(const Steps& steps) {
  return steps.answers->contacts.data();
}

/// Extents and strides in front of a contact's own.
struct Frame {
  Shape extents, strides;
};

Frame frameOf(const Step& step) {
  return {{static_cast<py::ssize_t>(step.answers->links())}, {kContactBytes}};
}
Frame frameOf(const Steps& steps) {
  const auto links = static_cast<py::ssize_t>(steps.answers->links());
  return {{static_cast<py::ssize_t>(steps.answers->counters.size()), links},
          {links * kContactBytes, kContactBytes}};
}

/// A view that cannot be written to; `owner` lives as long as it does.
template <typename Element>
py::array view(const Element* first, Frame frame, py::handle owner) {
  py::array array(py::dtype::of<Element>(), frame.extents, frame.strides, first, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

template <typename Holder, typename Element>
auto column(Element LinkContact::*field) {
  return [field](const py::object& self) {
    const auto& holder = self.cast<const Holder&>();
    return view(&(firstOf(holder)->*field), frameOf(holder), self);
  };
}

/// Computed for each contact: only the contact says whether its depth is known.
template <typename Holder>
py::array depthsOf(const Holder& holder) {
  const Frame frame = frameOf(holder);
  py::array_t<double> depths(frame.extents);
  std::transform(firstOf(holder), firstOf(holder) + depths.size(), depths.mutable_data(),
                 [](const LinkContact& contact) { return toldDepth(contact); });
  depths.attr("flags").attr("writeable") = false;
  return depths;
}

template <typename Holder>
auto points(Vector3d LinkContact::*field) {
  return [field](const py::object& self) {
    const auto& holder = self.cast<const Holder&>();
    Frame frame = frameOf(holder);
    frame.extents.push_back(3);
    frame.strides.push_back(sizeof(double));
    return view((firstOf(holder)->*field).data(), frame, self);
  };
}

template <typename Holder>
void defineArrays(py::class_<Holder>& type) {
  type.def_property_readonly(
          "verdicts",
          [](const py::object& self) {
            const auto& holder = self.cast<const Holder&>();
            const auto* const first =
                reinterpret_cast<const std::uint8_t*>(&firstOf(holder)->verdict);
            return view(first, frameOf(holder), self);
          },
          "uint8, to be compared with Verdict.")
      .def_property_readonly("toi", column<Holder>(&LinkContact::toi),
                             "Of contacts; 1 where there is none.")
      .def_property_readonly("free_until", column<Holder>(&LinkContact::freeUntil))
      .def_property_readonly("separation", column<Holder>(&LinkContact::separation))
      .def_property_readonly("penetration", &depthsOf<Holder>,
                             "Of what starts in contact; NaN where it is not known, 0 elsewhere.")
      .def_property_readonly("triangles", column<Holder>(&LinkContact::triangle),
                             "-1 where there is no contact.")
      .def_property_readonly("points", points<Holder>(&LinkContact::p_WScene), "On the scene.")
      .def_property_readonly("points_on_link", points<Holder>(&LinkContact::p_WLink))
      .def_property_readonly("normals", points<Holder>(&LinkContact::nhat_SL_W),
                             "Unit, from the scene to the link; zero where there is no contact.")
      .def_property_readonly(
          "link_names",
          [](const Holder& holder) {
            const Avatar& avatar = *holder.answers->avatar;
            py::list names;
            for (LinkId link = 0; link < avatar.numLinks(); ++link)
              names.append(nameOf(avatar, link));
            return names;
          },
          "Of the last axis of the arrays (of the one before for points).");
}

// ---- Step and Steps ----

/// A function of the part that is written in Python, for notebooks.
py::object notebook(const char* function) {
  return py::module_::import("foretouch._notebook").attr(function);
}

std::vector<Contact> contacts(const Step& step) {
  std::vector<LinkId> reported;
  listReported(firstOf(step), step.answers->links(), reported);
  std::vector<Contact> found;
  for (const LinkId link : reported) {
    found.push_back({step.answers, step.step * step.answers->links() + std::size_t(link)});
  }
  return found;
}

py::list contactList(const Step& step) {
  py::list list;
  for (Contact& contact : contacts(step)) list.append(py::cast(std::move(contact)));
  return list;
}

/// The step's part of a list; `end` has where each step's part ends.
std::pair<std::size_t, std::size_t> placesIn(const std::vector<std::size_t>& end,
                                             const Step& step) {
  return {step.step == 0 ? 0 : end[step.step - 1], end[step.step]};
}
std::pair<std::size_t, std::size_t> placesOfPairs(const Step& step) {
  return placesIn(step.answers->pairsEnd, step);
}

/// None if own links were not asked.
py::object pairList(const Step& step) {
  if (!step.answers->asksSelf()) return py::none();
  py::list list;
  const auto [begin, end] = placesOfPairs(step);
  for (std::size_t place = begin; place < end; ++place) {
    list.append(py::cast(PairContact{{step.answers, place, ContactList::Pairs}}));
  }
  return std::move(list);
}

/// None if objects were not asked one by one.
py::object objectList(const Step& step) {
  if (!step.answers->asksObjects()) return py::none();
  py::list list;
  const auto [begin, end] = placesIn(step.answers->perObjectEnd, step);
  for (std::size_t place = begin; place < end; ++place) {
    list.append(py::cast(Contact{step.answers, place, ContactList::Objects}));
  }
  return std::move(list);
}

bool isClear(const Step& step) {
  const auto [begin, end] = placesOfPairs(step);
  return begin == end && contacts(step).empty();
}

double freePrefix(const Step& step) {
  const LinkContact* const first = firstOf(step);
  double least = 1.0;
  for (std::size_t i = 0; i < step.answers->links(); ++i) {
    least = std::min(least, first[i].freeUntil);
  }
  const auto [begin, end] = placesOfPairs(step);
  for (std::size_t place = begin; place < end; ++place) {
    least = std::min(least, step.answers->pairs[place].freeUntil);
  }
  return least;
}

py::dict counterDict(const Step& step) {
  py::dict counters;
  for (const auto& [name, field] : kCounterFields) {
    counters[name] = step.answers->counters[step.step].*field;
  }
  return counters;
}

std::string stepText(const Step& step) {
  std::string text = "<foretouch.Step: ";
  const auto found = contacts(step);
  if (isClear(step)) return text + "all " + std::to_string(step.answers->links()) + " links clear>";
  const auto [begin, end] = placesOfPairs(step);
  if (end > begin) text += std::to_string(end - begin) + " pairs of own links not clear, ";
  if (found.empty()) return text + "scene not met>";
  return text + std::to_string(found.size()) + " links not clear, first " + textOf(found.front()) +
         ">";
}

void bindStep(py::module_& module) {
  py::class_<Step> type(module, "Step",
                        "What every link meets first in one motion. The arrays have one element a\n"
                        "link, in the avatar's order; they are views and cannot be written to.");
  defineArrays(type);
  type.def_property_readonly("contacts", &contactList,
                             "Of the links that are not clear, earliest first.")
      .def_property_readonly("pairs", &pairList,
                             "PairContact: the asked pairs of own links that are not clear, in "
                             "the same order.\n"
                             "None where own links were not asked (self_pairs).")
      .def_property_readonly("objects", &objectList,
                             "The first Contact of every link with every object, in the same "
                             "order; the others never\n"
                             "touch. None unless scope is 'objects'.")
      .def_property_readonly("is_clear", &isClear,
                             "Whether every link, and every asked pair of own links, is proven\n"
                             "free on the whole motion.")
      .def_property_readonly("free_prefix", &freePrefix,
                             "No link, and no asked pair, touches anything before this t: the\n"
                             "least free_until.")
      .def_property_readonly("counters", &counterDict, "Work done, by kind.")
      .def(
          "__getitem__",
          [](const Step& step, const Shown<shown::Link>& link) {
            const auto id = linkOf(*step.answers->avatar, link, "link");
            return Contact{step.answers, step.step * step.answers->links() + std::size_t(id)};
          },
          py::arg("link"), "The Contact of a link, by name or index, clear ones included.")
      .def("__len__", [](const Step& step) { return step.answers->links(); })
      .def("_repr_html_", [](const py::object& self) { return notebook("step_html")(self); })
      .def("__repr__", &stepText);
}

void bindSteps(py::module_& module) {
  py::class_<Steps> type(
      module, "Steps",
      "What every link meets first in each of many motions. The arrays have the\n"
      "steps in front: (steps, links, ...); they are views and cannot be\n"
      "written to.");
  defineArrays(type);
  type.def(
          "__getitem__",
          [](const Steps& steps, py::ssize_t index) {
            const auto count = static_cast<py::ssize_t>(steps.answers->counters.size());
            if (index < -count || index >= count) throw py::index_error("no such step");
            return Step{steps.answers, std::size_t(index < 0 ? index + count : index)};
          },
          py::arg("index"))
      .def(
          "plot",
          [](const py::object& self, const Shown<shown::Axes>& axes,
             const Shown<shown::Number>& secondsPerStep) -> Shown<shown::Axes> {
            return notebook("plot_steps")(self, axes, py::arg("seconds_per_step") = secondsPerStep);
          },
          py::arg("axes") = py::none(), py::kw_only(), py::arg("seconds_per_step") = py::none(),
          "Draws with matplotlib, on axes or on new ones, and returns these: over time, a row per\n"
          "link that is not always clear; marks where contacts are made, bars for what follows\n"
          "in the step.")
      .def("__len__", [](const Steps& steps) { return steps.answers->counters.size(); })
      .def("__repr__", [](const Steps& steps) {
        return "<foretouch.Steps: " + std::to_string(steps.answers->counters.size()) +
               " steps of " + std::to_string(steps.answers->links()) + " links>";
      });
}

}  // namespace

void Answers::add(StepContacts&& step) {
  contacts.insert(contacts.end(), step.links.begin(), step.links.end());
  counters.push_back(step.counters);
  pairs.insert(pairs.end(), step.pairs.begin(), step.pairs.end());
  pairsEnd.push_back(pairs.size());
  perObject.insert(perObject.end(), step.perObject.begin(), step.perObject.end());
  perObjectEnd.push_back(perObject.size());
}

void bindAnswers(py::module_& module) {
  bindStep(module);
  bindSteps(module);
}

}  // namespace foretouch::python
