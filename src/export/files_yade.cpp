#include <fmt/format.h>

#include "export/export_job.hpp"
#include "export/files.hpp"

namespace recoil {
namespace {

constexpr const char* yade_head = R"py(# -*- coding: utf-8 -*-
@HEADING@#
# Run:  yade -n -x impact.py V [DT]       V: incident velocity [m/s]; DT: time step [s]
# It prints "restitution E"; 0 means that the sphere stayed.
import math
import sys

V = float(sys.argv[1]) if len(sys.argv) > 1 else @V@
DT = float(sys.argv[2]) if len(sys.argv) > 2 else @DT@
DURATION = @DURATION@  # a sphere still in contact then has stayed [s]
R = @R@  # [m]
)py";

constexpr const char* yade_force = R"py(K = @K@  # [Pa]
@ADHESION@
C_H = @CH@  # [s/m]
C_A = @CA@  # [s/m]
D = @DASHPOT@  # dashpot of the mechanisms [N s m^(-3/2)]
PARTED = @PARTED@  # penetration at which the contact parts [m]


def force(n, v):
    """Force on the sphere [N] at the penetration n [m] and the velocity v [m/s] off the wall."""
    acts = @ACTS@
@LAW@

sphere = O.bodies.append(utils.sphere((0, 0, R), R, material=FrictMat(density=@RHO@)))
state = O.bodies[sphere].state
state.vel = (0, 0, -V)


def contact():
    n = R - state.pos[2]
    v = state.vel[2]
    # how much of the time around this step it is in contact: it may meet and part under a force
    depth = n - PARTED if v > 0 else n
    touch = min(1.0, max(0.0, 0.5 + depth / (max(abs(v), 1e-12) * DT)))
    if touch > 0:
        O.forces.addF(sphere, (0, 0, touch * force(max(n, PARTED), v)))
    elif v > 0:
        O.pause()


O.engines = [ForceResetter(), PyRunner(command="contact()", iterPeriod=1, initRun=True),
             NewtonIntegrator(damping=0, gravity=(0, 0, 0))]
O.dt = DT
O.run(int(math.ceil(DURATION / DT)), True)
back = state.vel[2] > 0 and R - state.pos[2] <= PARTED
print("restitution %.9f" % (state.vel[2] / V if back else 0.0))
sys.exit(0)
)py";

constexpr const char* yade_push =
    "    a = math.sqrt(R * n)\n"
    "    push = a * K * n * (1 - C_H * v) - D * math.sqrt(n) * v\n";
constexpr const char* yade_never_pulls = "    push = max(push, 0.0)\n";
constexpr const char* yade_ring = "    return push - 2 * math.pi * a * F0 * (1 + C_A * acts)\n";
constexpr const char* yade_dmt =
    "    return K * math.sqrt(R) * n**1.5 * (1 - C_H * v) - 2 * math.pi * W * R * (1 + C_A * "
    "acts)\n";
constexpr const char* yade_jkr =
    "    # a = a_p c^(2/3), n = U (c^(4/3) - 4 c^(1/3)): c in closed form (a quartic)\n"
    "    x = max(n / U, -3.0)\n"
    "    s = (1 + math.sqrt(abs(1 + x**3 / 27)))**(1 / 3)\n"
    "    y = 2 / (s**2 + x / 3 + x**2 / (9 * s**2))\n"
    "    c = ((math.sqrt(2 * y) + math.sqrt(abs(4 * math.sqrt(2 / y) - 2 * y))) / 2)**3\n"
    "    unit = K * (R * U)**1.5 / R\n"
    "    return unit * (c**2 * (1 - C_H * v) - 6 * c * (1 + C_A * acts))\n";

constexpr const char* yade_stock =
    R"py(# E = 1.5 K (1 - nu^2): both bodies have the same material, and E* = E / (2 (1 - nu^2))
material = O.materials.append(FrictMat(young=@E@, poisson=0.25, frictionAngle=0, density=@RHO@))
wall = O.bodies.append(utils.wall(0, axis=2, material=material))
sphere = O.bodies.append(utils.sphere((0, 0, R * (1 + 1e-9)), R, material=material))
state = O.bodies[sphere].state
state.vel = (0, 0, -V)
O.engines = [ForceResetter(),
             InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.1 * R),
             InteractionLoop([Ig2_Wall_Sphere_ScGeom()],
                             [Ip2_FrictMat_FrictMat_MindlinPhys(en=@RESTITUTION@, es=1.0)],
                             [Law2_ScGeom_MindlinPhys_Mindlin()]),
             NewtonIntegrator(damping=0, gravity=(0, 0, 0))]
O.dt = DT
O.run(int(math.ceil(DURATION / DT)), True)
print("restitution %.9f" % (state.vel[2] / V if state.vel[2] > 0 else 0.0))
sys.exit(0)
)py";

std::string yade_body(const ExportJob& job) {
  const ContactForce& f = job.force;
  if (job.form == ExportForm::approximation) {
    constexpr double poisson = 0.25;
    return filled(yade_stock, {{"E", shortest(1.5 * f.stiffness * (1.0 - poisson * poisson))},
                               {"RHO", shortest(f.density)},
                               {"RESTITUTION", shortest(job.stock->value)}});
  }
  const bool jkr = f.adhesion == AdhesionLaw::jkr && f.adhesion_energy > 0.0;
  const bool dmt = f.adhesion == AdhesionLaw::dmt;
  std::string adhesion = fmt::format("F0 = {}  # [N/m]", f.adhesion_force);
  if (jkr || dmt) adhesion = fmt::format("W = {}  # [J/m2]", f.adhesion_energy);
  if (jkr) adhesion += fmt::format("\nU = (math.pi * W * R**2 / (6 * K))**(2 / 3) / R  # [m]");
  const std::string ring =
      yade_push + std::string(f.never_pulls ? yade_never_pulls : "") + yade_ring;
  return filled(yade_force, {{"K", shortest(f.stiffness)},
                             {"ADHESION", adhesion},
                             {"CH", shortest(f.hertz_damping)},
                             {"CA", shortest(f.adhesion_damping)},
                             {"DASHPOT", shortest(f.dashpot)},
                             {"PARTED", jkr ? "-3 * U" : "0.0"},
                             {"ACTS", f.phase == AdhesionDampingPhase::both ? "v" : "max(v, 0.0)"},
                             {"LAW", jkr   ? yade_jkr
                                     : dmt ? yade_dmt
                                           : ring},
                             {"RHO", shortest(f.density)}});
}

}  // namespace

std::vector<WholeFile> yade_files(const ExportJob& job) {
  const std::string head = filled(yade_head, {{"HEADING", commented(job.heading, "# ")},
                                              {"V", shortest(typical_velocity(job.impact))},
                                              {"DT", shortest(time_step(job.impact))},
                                              {"DURATION", shortest(longest_run(job))},
                                              {"R", shortest(job.force.radius)}});
  return {{"impact.py", head + yade_body(job)}};
}

}  // namespace recoil
