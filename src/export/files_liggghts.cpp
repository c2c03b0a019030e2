#include "export/export_job.hpp"
#include "export/files.hpp"

namespace recoil {
namespace {

// LIGGGHTS takes a Young's modulus from 5e6 to 1e9 Pa, and beyond either only when told so.
constexpr double softest = 5e6;
constexpr const char* soft_text =
    "soft_particles yes               # allows a Young's modulus below 5e6 Pa";
constexpr const char* hard_text =
    "hard_particles yes               # allows a Young's modulus beyond 1e9 Pa";

constexpr const char* liggghts_text = R"in(@HEADING@#
# Run:  liggghts -in impact.liggghts -var V @V@       V: incident velocity [m/s]
# It ends with "restitution E".

variable V index @V@
variable dt index @DT@               # time step [s]
variable duration index @DURATION@   # [s]

units si
@RANGE@
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
region box block -@SIDE@ @SIDE@ -@SIDE@ @SIDE@ -@SIDE@ @TOP@ units box
create_box 1 box
neighbor @SKIN@ bin
neigh_modify delay 0
create_atoms 1 single 0 0 @START@
set atom 1 diameter @D@ density @RHO@
velocity all set 0 0 -$V
timestep ${dt}

# E = 1.5 K (1 - nu^2): both bodies have the same material here, and E* = E / (2 (1 - nu^2))
fix elastic all property/global youngsModulus peratomtype @E@
fix poisson all property/global poissonsRatio peratomtype 0.25
fix restitution all property/global coefficientRestitution peratomtypepair 1 @RESTITUTION@
fix friction all property/global coefficientFriction peratomtypepair 1 0.0
pair_style gran model hertz tangential no_history
pair_coeff * *
fix wall all wall/gran model hertz tangential no_history primitive type 1 zplane 0.0
fix move all nve/sphere

compute velocity all reduce max vz
variable e equal "c_velocity/v_V"
variable steps equal "ceil(v_duration/v_dt)"
thermo_style custom step c_velocity
thermo 1000000000
run ${steps}
variable shown equal ${e}
print "restitution ${shown}"
)in";

}  // namespace

std::vector<WholeFile> liggghts_files(const ExportJob& job) {
  const ContactForce& f = job.force;
  constexpr double poisson = 0.25;
  const double modulus = 1.5 * f.stiffness * (1.0 - poisson * poisson);
  const double side = rounded(8.0 * f.radius, 2);
  return {{"impact.liggghts",
           filled(liggghts_text, {{"HEADING", commented(job.heading, "# ")},
                                  {"V", shortest(typical_velocity(job.impact))},
                                  {"DT", shortest(time_step(job.impact))},
                                  {"DURATION", shortest(longest_run(job))},
                                  {"SIDE", shortest(side)},
                                  {"TOP", shortest(4.0 * side)},
                                  {"SKIN", shortest(rounded(0.5 * f.radius, 1))},
                                  {"START", shortest(f.radius)},
                                  {"D", shortest(2.0 * f.radius)},
                                  {"RHO", shortest(f.density)},
                                  {"RANGE", modulus < softest ? soft_text : hard_text},
                                  {"E", shortest(modulus)},
                                  {"RESTITUTION", shortest(job.stock->value)}})}};
}

}  // namespace recoil
