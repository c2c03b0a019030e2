#include "export/simbody.hpp"

#include <fmt/format.h>

#include "export/filled.hpp"

namespace recoil {
namespace {

constexpr const char* simbody_head = R"(@HEADING@//
// Build:  g++ -O1 impact.cpp -o impact $(pkg-config --cflags --libs simbody)
// Run:    ./impact V [ACCURACY]       V: incident velocity [m/s]; ACCURACY of the integrator
// It prints "restitution E"; 0 means that the sphere stayed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "Simbody.h"

using namespace SimTK;

namespace {

const double R = @R@;  // [m]
const double density = @RHO@;  // [kg/m3]
const double K = @K@;  // [Pa]
const double C_H = @CH@;  // [s/m]
const double parted = @PARTED@;  // penetration at which the contact parts [m]
const double duration = @DURATION@;  // a sphere still in contact then has stayed [s]
)";

constexpr const char* simbody_force = R"(const double C_A = @CA@;  // [s/m]
@ADHESION@
/// Force on the sphere [N] at the penetration n [m] and the velocity v [m/s] off the wall.
double law(double n, double v) {
  if (n < 0.0 && !(v > 0.0 && n > parted)) return 0.0;
  const double acts = @ACTS@;
@LAW@}

class FittedForce : public Force::Custom::Implementation {
 public:
  FittedForce(const MobilizedBody::Translation& sphere, double velocity, double unit)
      : sphere_(sphere), velocity_(velocity), unit_(unit) {}
  void calcForce(const State& state, Vector_<SpatialVec>& bodies, Vector_<Vec3>&,
                 Vector&) const override {
    const double n = R * (1.0 - sphere_.getQ(state)[1]);
    const double v = velocity_ * sphere_.getU(state)[1];
    sphere_.applyBodyForce(state, SpatialVec(Vec3(0), Vec3(0, law(n, v) / unit_, 0)), bodies);
  }
  Real calcPotentialEnergy(const State&) const override { return 0.0; }

 private:
  const MobilizedBody::Translation& sphere_;
  double velocity_, unit_;
};
)";

constexpr const char* simbody_main = R"(}  // namespace

int main(int argc, char** argv) {
  const double V = argc > 1 ? std::atof(argv[1]) : @V@;
  const double accuracy = argc > 2 ? std::atof(argv[2]) : 1e-9;
  const double mass = density * 4.0 / 3.0 * Pi * R * R * R;
  const double unit = mass * V * V / R;  // of forces: lengths count in R, velocities in V
  MultibodySystem system;
  SimbodyMatterSubsystem matter(system);
  GeneralForceSubsystem forces(system);
  GeneralContactSubsystem contacts(system);
  Body::Rigid body(MassProperties(1.0, Vec3(0), UnitInertia::sphere(1.0)));
  MobilizedBody::Translation sphere(matter.Ground(), Transform(), body, Transform());
@CONTACT@
  State start = system.realizeTopology();
  sphere.setQ(start, Vec3(0, 1, 0));
  sphere.setU(start, Vec3(0, -1, 0));
  RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(accuracy);
  TimeStepper stepper(system, integrator);
  stepper.initialize(start);
  double e = 0.0;
  const int looks = 20000;
  for (int k = 1; k <= looks; ++k) {
    stepper.stepTo(duration * V / R * k / looks);
    const State& now = stepper.getState();
    if (sphere.getU(now)[1] > 0.0 && R * (1.0 - sphere.getQ(now)[1]) <= parted) {
      e = sphere.getU(now)[1];
      break;
    }
  }
  std::printf("restitution %.9f\n", e);
  return 0;
}
)";

constexpr const char* own_contact =
    "  Force::Custom contact(forces, new FittedForce(sphere, V, unit));\n";

constexpr const char* hunt_crossley_contact =
    R"(  // Simbody's law is k x^1.5 (1 + (3/2) c v). Two bodies of modulus E make k = (4/3) E / 2^1.5.
  const ContactSetIndex set = contacts.createContactSet();
  contacts.addBody(set, sphere, ContactGeometry::Sphere(1.0), Transform());
  contacts.addBody(set, matter.Ground(), ContactGeometry::HalfSpace(),
                   Transform(Rotation(-Pi / 2.0, ZAxis), Vec3(0)));
  HuntCrossleyForce contact(forces, contacts, set);
  const double modulus = std::pow(2.0, 1.5) * 0.75 * K * R * R / unit;
  for (int side = 0; side < 2; ++side) {
    contact.setBodyParameters(ContactSurfaceIndex(side), modulus, C_H * V / 1.5, 0, 0, 0);
  }
)";

constexpr const char* ring_in_cpp =
    "  const double a = std::sqrt(R * n);\n"
    "  return a * (K * n * (1.0 - C_H * v) - 2.0 * Pi * f0 * (1.0 + C_A * acts)) -\n"
    "         D * std::sqrt(n) * v;\n";
constexpr const char* dmt_in_cpp =
    "  return K * std::sqrt(R) * n * std::sqrt(n) * (1.0 - C_H * v) -\n"
    "         2.0 * Pi * W * R * (1.0 + C_A * acts);\n";
constexpr const char* jkr_in_cpp =
    R"(  // a = a_p c^(2/3), n = U (c^(4/3) - 4 c^(1/3)): c in closed form (a quartic)
  const double x = std::max(n / U, -3.0);
  const double s = std::cbrt(1.0 + std::sqrt(std::abs(1.0 + x * x * x / 27.0)));
  const double y = 2.0 / (s * s + x / 3.0 + x * x / (9.0 * s * s));
  const double z =
      0.5 * (std::sqrt(2.0 * y) + std::sqrt(std::abs(4.0 * std::sqrt(2.0 / y) - 2.0 * y)));
  const double c = z * z * z;
  return K * std::pow(R * U, 1.5) / R *
         (c * c * (1.0 - C_H * v) - 6.0 * c * (1.0 + C_A * acts));
)";

std::string literal(double value) { return fmt::format("{:#}", value); }

std::string law_of(const ContactForce& f, bool jkr) {
  const bool dmt = f.adhesion == AdhesionLaw::dmt;
  std::string adhesion =
      jkr || dmt ? fmt::format("const double W = {};  // [J/m2]\n", literal(f.adhesion_energy))
                 : fmt::format(
                       "const double f0 = {};  // [N/m]\n"
                       "const double D = {};  // dashpot of the mechanisms\n",
                       literal(f.adhesion_force), literal(f.dashpot));
  if (jkr) {
    adhesion += "const double U = std::pow(Pi * W * R * R / (6.0 * K), 2.0 / 3.0) / R;  // [m]\n";
  }
  return filled(simbody_force,
                {{"CA", literal(f.adhesion_damping)},
                 {"ADHESION", adhesion},
                 {"ACTS", f.phase == AdhesionDampingPhase::both ? "v" : "std::max(v, 0.0)"},
                 {"LAW", jkr   ? jkr_in_cpp
                         : dmt ? dmt_in_cpp
                               : ring_in_cpp}});
}

}  // namespace

std::vector<ExportedFile> simbody_files(const ExportJob& job) {
  const ContactForce f =
      job.form == ExportForm::approximation ? force_of(*job.stock, job.impact) : job.force;
  const bool stock = f.adhesion_force == 0.0 && f.dashpot == 0.0;
  const bool jkr = !stock && f.adhesion == AdhesionLaw::jkr;
  std::string text = filled(simbody_head, {{"HEADING", commented(job.heading, "// ")},
                                           {"R", literal(f.radius)},
                                           {"RHO", literal(f.density)},
                                           {"K", literal(f.stiffness)},
                                           {"CH", literal(f.hertz_damping)},
                                           {"PARTED", jkr ? literal(-3.0 * f.jkr_length()) : "0.0"},
                                           {"DURATION", literal(longest_run(job.impact))}});
  if (!stock) text += law_of(f, jkr);
  text += filled(simbody_main, {{"V", literal(typical_velocity(job.impact))},
                                {"CONTACT", stock ? hunt_crossley_contact : own_contact}});
  return {{"impact.cpp", text}};
}

}  // namespace recoil
