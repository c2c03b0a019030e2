#include <cmath>

#include "export/export_job.hpp"
#include "export/files.hpp"

namespace recoil {
namespace {

// SI to um, us and pg.
constexpr double um = 1e6;
constexpr double us = 1e6;
constexpr double pascal = 1e-3;           // pg / (um us^2)
constexpr double newton_per_meter = 1e3;  // pg / us^2; J/m2 too
constexpr double newton = 1e9;            // pg um / us^2
constexpr double density = 1e-3;          // kg/m3 to pg/um^3
constexpr double dashpot = 1e6;           // N s m^(-3/2) to pg um^(-1/2) / us

constexpr const char* lammps_frame = R"in(@HEADING@#
# Run:  lmp -in impact.lammps -var V @V@       V: incident velocity [m/s]
# It ends with "restitution E"; 0 means that the sphere stayed.

variable V index @V@
variable dt index @DT@            # time step [us]
variable duration index @DURATION@   # a sphere still in contact then has stayed [us]

units micro                       # um, us, pg
atom_style sphere
atom_modify map array
boundary f f f
@NEWTON@region box block -@SIDE@ @SIDE@ -@SIDE@ @SIDE@ -@SIDE@ @TOP@ units box
create_box 1 box
create_atoms 1 single 0 0 @R@
set atom 1 diameter @D@ density @RHO@
velocity all set 0 0 -$V
@WALL@comm_modify cutoff @SIDE@
timestep ${dt}

@FORCE@
fix move all nve
variable gone equal "(vz[1]>0)*(z[1]>=@RELEASE@)"
fix over all halt 100 v_gone > 0.5 error continue message no
variable e equal "vz[1]/v_V*v_gone+0"
variable steps equal "ceil(v_duration/v_dt)"
thermo 0
run ${steps}
print "restitution $(v_e:%.9f)"
)in";

constexpr const char* lammps_ring = R"in(# penetration n [um]; eq. 5 of Li, Dunn & Brach (1999)
variable R equal @R@
variable K equal @K@        # [1e3 Pa]
variable f0 equal @F0@      # [1e-3 N/m]
variable CH equal @CH@      # [s/m]
variable CA equal @CA@      # [s/m]
variable D equal @DASHPOT@  # dashpot of the mechanisms
variable n atom "(v_R-z+abs(v_R-z))/2"
variable push atom "sqrt(v_R*v_n)*v_K*v_n*(1-v_CH*vz)-v_D*sqrt(v_n)*vz"
variable fz atom "@PUSH@-sqrt(v_R*v_n)*2*PI*v_f0*(1+v_CA*@ACTS@)"
fix contact all addforce 0 0 v_fz
pair_style none
)in";

constexpr const char* lammps_dmt =
    R"in(# penetration n [um]; Hertz under the pull 2 pi W R of Derjaguin, Muller & Toporov (1975)
variable R equal @R@
variable K equal @K@        # [1e3 Pa]
variable W equal @W@        # [1e-3 J/m2]
variable CH equal @CH@      # [s/m]
variable CA equal @CA@      # [s/m]
variable n atom "(v_R-z+abs(v_R-z))/2"
# how much of the time around this step it is in contact: it parts under a force that is not zero
variable part atom "0.5+(v_R-z)/((vz+(vz<=0))*v_dt)"
variable touch atom "(vz<=0)*(z<=v_R)+(vz>0)*(abs(v_part)-abs(v_part-1)+1)/2"
variable fz atom "v_K*sqrt(v_R)*v_n^1.5*(1-v_CH*vz)-v_touch*2*PI*v_W*v_R*(1+v_CA*@ACTS@)"
fix contact all addforce 0 0 v_fz
pair_style none
)in";

constexpr const char* lammps_jkr =
    R"in(# Johnson, Kendall & Roberts (1971): the contact opens at n = 0 and parts at n = -3 u. With
# a = a_p c^(2/3), n = u (c^(4/3) - 4 c^(1/3)): c from n in closed form (a quartic). The first impact
# is exact; a sphere that stayed is not pulled on its way in from below n = 0.
# W = @W@ J/m2, u = a_p^2 / R, a_p^3 = pi W R^2 / (6 K)
variable R equal @R@
variable CH equal @CH@      # [s/m]
variable CA equal @CA@      # [s/m]
variable u equal @U@        # [um]
variable P equal @P@        # K a_p^3 / R [nN]
variable nu atom "((v_R-z)/v_u-3+abs((v_R-z)/v_u+3))/2"
compute nu all reduce sum v_nu    # of the one atom: a compute is worked out once per step
variable s atom "(1+sqrt(abs(1+c_nu^3/27)))^(1/3)"
compute s all reduce sum v_s
variable p atom "2/sqrt(c_s^2+c_nu/3+c_nu^2/(9*c_s^2))"
compute p all reduce sum v_p
variable c atom "((c_p+sqrt(abs(8/c_p-c_p^2)))/2)^3"
compute c all reduce sum v_c
# how much of the time around this step it is in contact: it parts under a force that is not zero
variable part atom "0.5+(v_R+3*v_u-z)/((vz+(vz<=0))*v_dt)"
variable touch atom "(vz<=0)*(z<=v_R)+(vz>0)*(abs(v_part)-abs(v_part-1)+1)/2"
variable fz atom "v_touch*v_P*(c_c^2*(1-v_CH*vz)-6*c_c*(1+v_CA*@ACTS@))"
fix contact all addforce 0 0 v_fz
pair_style none
)in";

// At a wall this version uses E* = E / (2 (1 - nu)), which a comparison of e shows, instead of E /
// (2 (1 - nu^2)) for a wall of the same material or E / (1 - nu^2) for a rigid wall (issue 4141 of
// lammps). With nu = 0, which friction does not forbid here, the first two are equal.
constexpr const char* lammps_stock =
    R"in(# Hertz with the damping -eta m a n', which is the one number chosen. E = 1.5 K with nu = 0: at a
# wall LAMMPS takes half of E for E* then, at least up to the version this was tried with.
pair_style granular
pair_coeff * * hertz/material @E@ @ETA@ 0 tangential linear_nohistory 0 0 damping viscoelastic
fix contact all wall/gran granular hertz/material @E@ @ETA@ 0 &
    tangential linear_nohistory 0 0 damping viscoelastic zplane 0.0 NULL
)in";

// From pair_granular.cpp and fix_wall_gran.cpp of this version and from
// gran_sub_mod_normal_kernel.h of 2026. Without a history of the tangential force this version ends
// with "Neighbor history overflow".
constexpr const char* lammps_stock_jkr =
    R"in(# Johnson, Kendall & Roberts (1971) with the damping -eta m a n', a the contact
# radius: eta and the surface energy gamma are chosen. E = 1.5 K with nu = 0. It
# parts at the largest pull. In the version of 29 Sep 2021 the jkr of fix
# wall/gran parts at a wrong distance: a sphere that does not move is the wall
# here. In current versions a wall is, with the words after "* *",
#   fix ID all wall/gran granular WORDS zplane 0.0 NULL
pair_style granular
pair_coeff * * jkr @E@ @ETA@ 0 @GAMMA@ &
    tangential linear_history 0 0 0 damping viscoelastic
group wall id 2
fix still wall freeze
)in";

constexpr const char* lammps_wall = R"in(create_atoms 1 single 0 0 -@WALLR@
set atom 2 diameter @WALLD@
)in";
constexpr double wall_radius = 1e4;  // of the sphere's

std::string force_text(const ExportJob& job) {
  const ContactForce& f = job.force;
  if (job.form == ExportForm::approximation && job.stock->model == StockModel::jkr) {
    return filled(lammps_stock_jkr, {{"E", shortest(1.5 * f.stiffness * pascal)},
                                     {"ETA", shortest(job.stock->value / (us * um))},
                                     {"GAMMA", shortest(job.stock->energy * newton_per_meter)}});
  }
  if (job.form == ExportForm::approximation) {
    return filled(
        lammps_stock,
        {{"E", shortest(1.5 * f.stiffness * pascal)},
         {"ETA", shortest(job.stock->value / (f.mass() * std::sqrt(f.radius)) / (us * um))}});
  }
  const bool jkr = f.adhesion == AdhesionLaw::jkr;
  const char* const law = f.adhesion == AdhesionLaw::ring  ? lammps_ring
                          : f.adhesion == AdhesionLaw::dmt ? lammps_dmt
                                                           : lammps_jkr;
  const double unit = f.stiffness * std::pow(f.radius * f.jkr_length(), 1.5) / f.radius;
  return filled(law, {{"R", shortest(f.radius * um)},
                      {"K", shortest(f.stiffness * pascal)},
                      {"F0", shortest(f.adhesion_force * newton_per_meter)},
                      {"W", shortest(f.adhesion_energy * (jkr ? 1.0 : newton_per_meter))},
                      {"CH", shortest(f.hertz_damping)},
                      {"CA", shortest(f.adhesion_damping)},
                      {"DASHPOT", shortest(f.dashpot * dashpot)},
                      {"PUSH", f.never_pulls ? "(v_push+abs(v_push))/2" : "v_push"},
                      {"U", shortest(f.jkr_length() * um)},
                      {"P", shortest(unit * newton)},
                      {"ACTS", f.phase == AdhesionDampingPhase::both ? "vz" : "(vz>0)*vz"}});
}

}  // namespace

std::vector<WholeFile> lammps_files(const ExportJob& job) {
  const ContactForce& f = job.force;
  const bool exact = job.form != ExportForm::approximation;
  const bool stock_jkr = !exact && job.stock->model == StockModel::jkr;
  const bool parts_outside = exact && f.adhesion == AdhesionLaw::jkr && f.adhesion_energy > 0.0;
  const double side = rounded((stock_jkr ? 2.2 * wall_radius : 8.0) * f.radius * um, 2);
  std::string release = parts_outside ? "v_R+3*v_u" : shortest(f.radius * um);
  std::string wall;
  if (stock_jkr) {
    release = shortest((f.radius + 3.0 * jkr_of(*job.stock, job.impact).scales().length) * um);
    wall = filled(lammps_wall, {{"WALLR", shortest(wall_radius * f.radius * um)},
                                {"WALLD", shortest(2.0 * wall_radius * f.radius * um)}});
  }
  const std::string text =
      filled(lammps_frame, {{"HEADING", commented(job.heading, "# ")},
                            {"V", shortest(typical_velocity(job.impact))},
                            {"DT", shortest(time_step(job.impact) * us)},
                            {"DURATION", shortest(longest_run(job) * us)},
                            {"NEWTON", exact ? "" : "newton off\ncomm_modify vel yes\n"},
                            {"SIDE", shortest(side)},
                            {"TOP", shortest(4.0 * side)},
                            {"R", shortest(f.radius * um)},
                            {"D", shortest(2.0 * f.radius * um)},
                            {"RHO", shortest(f.density * density)},
                            {"WALL", wall},
                            {"FORCE", force_text(job)},
                            {"RELEASE", release}});
  return {{"impact.lammps", text}};
}

}  // namespace recoil
