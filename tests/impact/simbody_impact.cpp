// Its headers are C++17: they do not compile as C++20, and nothing of recoil is included here.
#include "simbody_impact.hpp"

#include <Simbody.h>

#include <cmath>

namespace recoil {

double restitution_by_simbody(double C_H, double accuracy) {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter(system);
  SimTK::GeneralForceSubsystem forces(system);
  SimTK::GeneralContactSubsystem contacts(system);
  const SimTK::ContactSetIndex set = contacts.createContactSet();
  // The half-space is x > 0; the sphere comes along x.
  contacts.addBody(set, matter.updGround(), SimTK::ContactGeometry::HalfSpace(),
                   SimTK::Transform());
  const SimTK::Body::Rigid body(SimTK::MassProperties(1.0, SimTK::Vec3(0), SimTK::Inertia(1.0)));
  SimTK::MobilizedBody::Slider sphere(matter.updGround(), SimTK::Transform(), body,
                                      SimTK::Transform());
  contacts.addBody(set, sphere, SimTK::ContactGeometry::Sphere(1.0), SimTK::Transform());
  SimTK::HuntCrossleyForce force(forces, contacts, set);
  // Two equal bodies in series: (4/3) (k / 2^(3/2)) r^(1/2) n^(3/2), with k^(2/3) halved.
  const double stiffness = 1e3;
  for (int i = 0; i < 2; ++i) {
    force.setBodyParameters(SimTK::ContactSurfaceIndex(i), stiffness, 2.0 / 3.0 * C_H, 0.0, 0.0,
                            0.0);
  }
  SimTK::State state = system.realizeTopology();
  sphere.setOneQ(state, 0, -1.0);
  sphere.setOneU(state, 0, 1.0);
  const double K = 4.0 / 3.0 * stiffness / std::pow(2.0, 1.5);
  const double contact_time = 3.3 * std::pow(1.0 / K, 0.4);  // 3.21 n_c / V without damping
  SimTK::RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(accuracy);
  SimTK::TimeStepper stepper(system, integrator);
  stepper.initialize(state);
  stepper.stepTo(2.0 * contact_time);
  const SimTK::State& end = integrator.getState();
  return sphere.getOneQ(end, 0) < -1.0 ? -sphere.getOneU(end, 0) : std::nan("");
}

}  // namespace recoil
