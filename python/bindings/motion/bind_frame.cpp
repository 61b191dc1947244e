// SPDX-License-Identifier: MIT
// Reference frames: uniform precession, orbit planes, and any attitude that Python writes.
#include <array>

#include "charts/states.hpp"
#include "interface/dual_number.hpp"
#include "motion/frame_value.hpp"
#include "polhode/frame/frame.hpp"

namespace polhode::python {

namespace {

// A number that is constant, or a Python function of time; T is a Dual of one variable.
class FunctionOfTime {
 public:
  FunctionOfTime(nb::handle value, const std::string& label,
                 std::vector<SharedFunction>& functions) {
    if (is_real_scalar(value)) {
      constant_ = real_scalar(value);
      return;
    }
    if (!nb::isinstance<nb::str>(value)) require_plain(value, label.c_str());
    functions.push_back(std::make_shared<PythonFunction>(value, label));
    function_ = functions.back();
  }

  template <class T>
  T operator()(const T& t) const {
    T out(constant_);
    if (function_ == nullptr) return out;
    const WithGil acquired;
    const nb::object returned = (*function_)(to_python(t));
    if (!from_python(returned, out))
      function_->refuse(returned, "a number: a float, or a Dual made of the time");
    return out;
  }

 private:
  double constant_ = 0.0;
  SharedFunction function_;
};

class AttitudeOfTime {
 public:
  explicit AttitudeOfTime(SharedFunction function) : function_(std::move(function)) {}

  template <class T>
  BasicQuaternion<T> operator()(const T& t) const {
    const WithGil acquired;
    const nb::object returned = (*function_)(to_python(t));
    std::array<T, 4> q;
    const bool four = PySequence_Check(returned.ptr()) != 0 && nb::len(returned) == 4;
    for (std::size_t i = 0; i < 4; ++i)
      if (!four || !from_python(returned[i], q[i]))
        function_->refuse(returned, "4 numbers (w, x, y, z): floats, or Duals made of the time");
    return {q[0], q[1], q[2], q[3]};
  }

 private:
  SharedFunction function_;
};

FrameMotion checked(const FrameMotion& f) {
  require_finite("FrameMotion",
                 {f.q_IS.w, f.q_IS.x, f.q_IS.y, f.q_IS.z, f.mu_S.x, f.mu_S.y, f.mu_S.z});
  return f;
}

constexpr Chart<FrameMotion, 2> motion_chart{
    "FrameMotion",
    R"(Where a frame S is and how it turns, at one time or at an array of times. [SA section 4]

q_IS (..., 4): attitude, v_I = q_IS v_S q_IS*; mu_S (..., 3): its angular velocity with respect to
inertial axes, in components of S (rad per time).)",
    {{{"q_IS", "Attitude of the frame: v_I = q_IS v_S q_IS*; (..., 4).",
       offsetof(FrameMotion, q_IS), Kind::quaternion},
      {"mu_S",
       "Its angular velocity with respect to inertial axes, components of S, rad per time; (..., "
       "3).",
       offsetof(FrameMotion, mu_S), Kind::vector}}},
    checked};

PythonFrame precessing(ArrayLike axis, double rate, double epoch) {
  const Vec3 a = vec3(axis, "axis");
  return PythonFrame(Frame::precessing(a, rate, epoch),
                     recipe_of("precessing", {"axis", "rate", "epoch"},
                               nb::make_tuple(nb::make_tuple(a.x, a.y, a.z), rate, epoch)));
}

using AngleOfTime = Typed<"typing.Callable[[Dual], Dual | float] | float">;

// As it was given; a number of any kind as a float.
nb::object kept(nb::handle value) {
  return is_real_scalar(value) ? nb::object(nb::float_(real_scalar(value))) : nb::borrow(value);
}

PythonFrame orbit_plane(AngleOfTime Omega, AngleOfTime i) {
  std::vector<SharedFunction> functions;
  const FunctionOfTime node(Omega, "Frame.orbit_plane: Omega", functions);
  const FunctionOfTime inclination(i, "Frame.orbit_plane: i", functions);
  return PythonFrame(Frame::orbit_plane(node, inclination),
                     recipe_of("orbit_plane", {"Omega", "i"}, nb::make_tuple(kept(Omega), kept(i)),
                               std::move(functions)));
}

PythonFrame orbit_plane_pq(AngleOfTime p, AngleOfTime q) {
  std::vector<SharedFunction> functions;
  const FunctionOfTime first(p, "Frame.orbit_plane_pq: p", functions);
  const FunctionOfTime second(q, "Frame.orbit_plane_pq: q", functions);
  return PythonFrame(Frame::orbit_plane_pq(first, second),
                     recipe_of("orbit_plane_pq", {"p", "q"}, nb::make_tuple(kept(p), kept(q)),
                               std::move(functions)));
}

using OrbitOfFrame = Typed<"KeplerOrbit | PrecessingKeplerOrbit | TurnedKeplerOrbit | TableOrbit">;

// What `made` makes of the orbit that it is.
template <class Made>
Frame frame_along(nb::handle orbit, const char* function, const Made& made) {
  if (nb::isinstance<KeplerOrbit>(orbit)) return made(nb::cast<const KeplerOrbit&>(orbit));
  if (nb::isinstance<PrecessingKeplerOrbit>(orbit))
    return made(nb::cast<const PrecessingKeplerOrbit&>(orbit));
  if (nb::isinstance<TurnedKeplerOrbit>(orbit))
    return made(nb::cast<const TurnedKeplerOrbit&>(orbit));
  if (nb::isinstance<TableOrbit>(orbit)) return made(nb::cast<const TableOrbit&>(orbit));
  throw nb::type_error(
      (std::string(function) + ": orbit: got " + nb::cast<std::string>(nb::repr(orbit)) +
       "; expected a KeplerOrbit, PrecessingKeplerOrbit, TurnedKeplerOrbit or TableOrbit")
          .c_str());
}

PythonFrame local_vertical(OrbitOfFrame orbit) {
  return PythonFrame(frame_along(orbit, "Frame.local_vertical",
                                 [](const auto& o) { return local_vertical_frame(o); }),
                     recipe_of("local_vertical", {"orbit"}, nb::make_tuple(orbit)));
}

PythonFrame plane_of(OrbitOfFrame orbit, const std::string& axis_1) {
  const bool node = axis_1 == "node";
  if (!node && axis_1 != "shortest-turn")
    throw nb::value_error(
        ("Frame.plane_of: axis_1: got \"" + axis_1 + "\"; expected \"node\" or \"shortest-turn\"")
            .c_str());
  const PlaneOrigin origin = node ? PlaneOrigin::node : PlaneOrigin::shortest_turn;
  return PythonFrame(frame_along(orbit, "Frame.plane_of",
                                 [&](const auto& o) { return orbit_plane_frame(o, origin); }),
                     recipe_of("plane_of", {"orbit", "axis_1"}, nb::make_tuple(orbit, axis_1)));
}

PythonFrame from_attitude(
    Typed<"typing.Callable[[Dual], collections.abc.Sequence[Dual | float]]"> q_IS) {
  const auto function = std::make_shared<PythonFunction>(q_IS, "Frame.from_attitude: q_IS");
  return PythonFrame(Frame::from_attitude(AttitudeOfTime(function)),
                     recipe_of("from_attitude", {"q_IS"}, nb::make_tuple(q_IS), {function}));
}

std::string kind_of(const PythonFrame& frame) {
  if (frame.is_inertial()) return "inertial";
  return frame.recipe.is_known() ? frame.recipe.method : "moving";
}

template <class Class>
void def_makers(Class& c) {
  c.def_static(
       "inertial",
       [] { return PythonFrame(Frame::inertial(), recipe_of("inertial", {}, nb::make_tuple())); },
       "Axes that do not turn.")
      .def_static(
          "precessing", precessing, "axis"_a, "rate"_a, "epoch"_a = 0.0,
          "Turning at a constant rate (rad per time) about a constant axis (3,), whose length does "
          "not matter; S coincides with inertial axes at `epoch`. ValueError for an axis of length "
          "0 and numbers that are not finite.")
      .def_static("orbit_plane", orbit_plane, "Omega"_a, "i"_a,
                  R"(The axes of an orbit: x along the ascending node, z along the normal.

Omega, i : node and inclination (rad): floats, or functions of time, written with + - * / ** and
    NumPy's functions. They are called with a Dual, so that mu_S is their exact derivative.

Frame.plane_of makes it of an orbit.

>>> polhode.Frame.orbit_plane(lambda t: 0.3 - 1e-7 * t, 0.9))")
      .def_static("orbit_plane_pq", orbit_plane_pq, "p"_a, "q"_a,
                  "The same plane without a node, regular at i = 0: p = sin(i) sin(Omega), q = "
                  "sin(i) cos(Omega), i <= 90 degrees; x is the direction that the shortest turn "
                  "brings from the inertial x axis. NaN where p^2 + q^2 > 1.")
      .def_static(
          "local_vertical", local_vertical, "orbit"_a,
          "The local vertical, local horizontal (LVLH) of an orbit: z to the centre, y against the "
          "normal of the orbit, x towards the motion. Roll, pitch and yaw of a satellite are its "
          "angles in it. Of a table the plane is that of position and velocity, NaN outside.")
      .def_static(
          "plane_of", plane_of, "orbit"_a, "axis_1"_a = "node",
          R"(The plane of an orbit at each time: z along the normal, x along the ascending node.

orbit : KeplerOrbit, PrecessingKeplerOrbit, TurnedKeplerOrbit: the plane of their elements at the
    time; a TableOrbit of order 4 or more: that of position and velocity, NaN outside.
axis_1 : "node", or "shortest-turn": x is where the shortest turn to the plane brings inertial x,
    for planes next to that of inertial axes 1 and 2, whose node runs.

Frame.orbit_plane makes it of node and inclination. mu_S is the derivative
of the attitude. ValueError for other words and tables of straight lines.)")
      .def_static("from_attitude", from_attitude, "q_IS"_a,
                  "Any attitude: a function of time that returns the quaternion (w, x, y, z), S to "
                  "inertial, of any length, made of the Dual that it is called with.");
}

std::string otherwise(const PythonFrame& frame) { return kind_of(frame); }

}  // namespace

void bind_frame(nb::module_& m) {
  bind_states<2>(m, motion_chart);
  nb::class_<PythonFrame> c(
      m, "Frame",
      R"(The reference frame S in which a rotation is described: kinematics only.

Made by Frame.inertial, .precessing, .orbit_plane, .orbit_plane_pq, .plane_of, .local_vertical,
.from_attitude.
A System adds what a moving frame does to the equations of motion, -mu . g. [SA section 4, (118)])",
      nb::type_slots(recipe_slots<PythonFrame>()));
  def_makers(c);
  def_recipe<PythonFrame>(c, otherwise);
  c.def_prop_ro(
       "is_inertial", [](const PythonFrame& f) { return f.is_inertial(); },
       "Whether it does not turn.")
      .def_prop_ro("kind", kind_of,
                   "\"inertial\", \"precessing\", \"orbit_plane\", \"orbit_plane_pq\", "
                   "\"local_vertical\", \"plane_of\", \"from_attitude\"; \"moving\" where a "
                   "scenario made it.")
      .def_prop_ro(
          "arguments", [](const PythonFrame& f) { return f.recipe.by_name(); },
          "What it was made from, by name.")
      .def(
          "at",
          [](const PythonFrame& f, ArrayLike t) {
            const Numbers times(t, "t");
            return mapped(times, [&](double at) { return f.at(at); });
          },
          "t"_a,
          "FrameMotion at times t of any shape. What a function in Python raises passes through.");
}

}  // namespace polhode::python
