// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "hooke/scene/foreign_keys.h"

#include <algorithm>
#include <string>

namespace hooke::scene {
namespace {

/// Keys with one meaning, with spaces around each, in lower case and without separators.
struct ForeignKeys {
  std::string_view keys;
  std::string_view hint;
};

constexpr ForeignKeys kForeignKeys[] = {
    {" restitution restitutioncoefficient coefficientrestitution coefficientofrestitution cor en eninput deseninput "
     "desenwallinput bounce bounciness elasticity ",
     "a contact's \"damping\" decides how high it bounces; docs/limits.md has the formula from a restitution"},
    {" etafac desetatfac desetatfacwall dampflag ",
     "\"damping\" (whole relative velocity) and \"shear\" (its tangential part) are given in N s/m; see "
     "docs/limits.md"},
    {" density rho rho0 ros0 density0 densityparticle particledensity ",
     "a material has a \"mass\" in kg: density x 4/3 pi radius^3"},
    {" young youngs youngsmodulus youngmodulus elasticmodulus emodulus emod poisson poissonratio poissonsratio "
     "shearmodulus characteristicvelocity hertz ",
     "contacts are linear, not Hertzian: give a \"stiffness\" in N/m; docs/limits.md says which one suits a Young's "
     "modulus"},
    {" kn knormal normalstiffness springconstant springstiffness knw ", "it is called \"stiffness\", in N/m"},
    {" kt ktangential tangentialstiffness ktfac ktwfac xkt ",
     "friction has no history and no tangential spring; give \"shear\" (N s/m) and \"friction\"; see docs/limits.md"},
    {" gamman gamman0 cn etan normaldamping dampingnormal dashpot ",
     "it is called \"damping\", in N s/m; it acts on the whole relative velocity; \"shear\" adds to its tangential "
     "part"},
    {" gammat ct etat tangentialdamping dampingtangential ",
     "it is called \"shear\", in N s/m; tangentially it adds to \"damping\""},
    {" mu xmu mew meww mus muk frictioncoefficient coefficientfriction coefficientoffriction frictioncoeff "
     "staticfriction dynamicfriction kineticfriction ",
     "it is called \"friction\", Coulomb's coefficient"},
    {" rollingfriction coefficientrollingfriction rollingresistance rollingfrictioncoefficient mur twistingfriction ",
     "particles have no rotation, so nothing rolls; see docs/limits.md for what to use instead"},
    {" omega spin torque inertia momentofinertia angularmomentum orientation quaternion ",
     "particles have no rotation; colliders turn by their \"motion\"; see docs/limits.md"},
    {" diameter dp dp0 particlediameter ", "a material has a \"radius\" in m: half of the diameter"},
    {" particleradius radii ", "each material has its \"radius\" in m"},
    {" viscosity dynamicviscosity kinematicviscosity viscositymethod ",
     "water is made of particles with \"shear\", \"damping\" and \"cohesion\"; there is no viscosity to set; see "
     "docs/limits.md"},
    {" surfacetension surfacetensionmethod cohesionenergydensity adhesion jkr bondnumber ",
     "surfaces attract by \"cohesion\": { \"range\": m, \"strength\": N }"},
    {" restdensity simulationmethod pressuresolver maxiterations cflmethod cflfactor stiffnessexponent maxerror ",
     "Hooke's fluids are soft spheres, no SPH; see docs/limits.md"},
    {" timestep timestepsize dt dtsolid deltat ", "it is \"time\": { \"step\": s }"},
    {" stopat tstop endtime duration nsteps runsteps numsteps totaltime ",
     "it is \"time\": { \"end\": s } or { \"steps\": N }"},
    {" boundary boundaries boundaryconditions bc bctype walls ",
     "it is \"domain\": { \"walls\": \"spring\", \"open\" or \"periodic\" }, one for all or one an axis"},
    {" gravitation gravityvector g ", "it is \"gravity\": [x, y, z], in m/s^2"},
    {" units unit atomstyle pairstyle paircoeff pairmodify bondstyle fix fixes compute computes neighmodify thermo "
     "region createbox createatoms readdata group atomtypes newton ",
     "a scene is no LAMMPS script; docs/from-lammps.md translates its commands"},
    {" configuration fluidmodels fluidblocks fluids emittermodels ",
     "fluids are \"particles\" and \"emitters\" of a material in \"materials\"; see docs/limits.md"},
    {" rigidbodies rigidbody bodyid isdynamic clumps clump multisphere multispheres nspheres ",
     "there are no rigid bodies: \"bodies\" are elastic, \"colliders\" move as they are told; see docs/limits.md"},
    {" obstacles obstacle meshes geometry ", "what is in the way is in \"colliders\""},
    {" timesteps dataexportfps fps outputfrequency dumpfrequency savefrequency ",
     "it is \"output\": { \"every\": s } or { \"every_steps\": N }"},
    {" temperature specificheat conductivity heatcapacity ", "there is no heat in Hooke; see docs/limits.md"},
};

}  // namespace

std::string_view foreign_key_hint(std::string_view key) {
  constexpr std::size_t kLongest = 40;
  if (key.size() > kLongest) return {};
  std::string plain = " ";
  for (const char c : key) {
    if (c >= 'A' && c <= 'Z') {
      plain += static_cast<char>(c - 'A' + 'a');
    } else if (c != '_' && c != '-' && c != ' ' && c != '\'') {
      plain += c;
    }
  }
  plain += ' ';
  if (plain.size() < 3) return {};
  const auto* const found = std::find_if(std::begin(kForeignKeys), std::end(kForeignKeys), [&plain](const auto& keys) {
    return keys.keys.find(plain) != std::string_view::npos;
  });
  return found == std::end(kForeignKeys) ? std::string_view() : found->hint;
}

}  // namespace hooke::scene
