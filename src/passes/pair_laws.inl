// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// The laws between the lanes' particles and other particles, walls and colliders, by the number of materials: a part of
// force_pass.inl, which includes it inside of the instruction set's namespace.

// How many materials there are, and whether their surfaces act: then contacts follow the law with surfaces. The
// coefficients of few materials are kept in registers; those of one without surfaces are constants.
enum class Materials { one, few, many, few_surfaces, many_surfaces };
HOOKE_HD constexpr bool have_surfaces(Materials m) {
  return m == Materials::few_surfaces || m == Materials::many_surfaces;
}
HOOKE_HD constexpr bool are_few(Materials m) { return m == Materials::few || m == Materials::few_surfaces; }

// The law of each lane's pair.
template <class Real>
struct LinearPair {
  ContactCoefficients<Pack<Real>> law;
  Pack<Real> contact_distance;
};
template <class Real>
struct SurfacePair {
  ContactLaw<Pack<Real>> law;
  Pack<Real> contact_distance;
};

// With one material, all pairs follow the same linear law.
struct UniformLaw {};
template <class Real>
struct UniformPair {
  UniformLaw law;
  Pack<Real> contact_distance;
};

// Copies a law register by register: GCC 12 copies a whole law through memory, 8 bytes at a time.
template <class Real>
HOOKE_HD void keep(UniformLaw, UniformLaw&) {}
template <class Real>
HOOKE_HD void keep(const ContactCoefficients<Pack<Real>>& law, ContactCoefficients<Pack<Real>>& to) {
  to.stiffness.v = law.stiffness.v;
  to.shear.v = law.shear.v;
  to.damping.v = law.damping.v;
}
template <class Real>
HOOKE_HD void keep(const ContactLaw<Pack<Real>>& law, ContactLaw<Pack<Real>>& to) {
  keep<Real>(law.linear, to.linear);
  to.surface.friction.v = law.surface.friction.v;
  to.surface.tension.v = law.surface.tension.v;
  to.surface.cohesion.v = law.surface.cohesion.v;
  to.surface.range.v = law.surface.range.v;
}

// One row per lane of a table of pairs.
template <class Real, Materials kMaterials>
HOOKE_HD auto load_pairs(const PairRow<Real>* table, const Pack<Real>& index) {
  const Quad<Real> linear = load_rows(table, index, 0);
  if constexpr (have_surfaces(kMaterials)) {
    const Quad<Real> surface = load_rows(table, index, 1);
    return SurfacePair<Real>{{{linear.a, linear.b, linear.c}, {surface.a, surface.b, surface.c, surface.d}}, linear.d};
  } else {
    return LinearPair<Real>{{linear.a, linear.b, linear.c}, linear.d};
  }
}

// The laws between the lanes' particles and others, by the others' materials.
template <class Real, Materials kMaterials>
struct PairTable {
  using P = Pack<Real>;
  HOOKE_HD PairTable(const ForcePass<Real>& pass, const P& material)
      : pairs(pass.rules.pairs),
        first(material * P(static_cast<Real>(pass.rules.material_count))) {}
  using Pair = std::conditional_t<have_surfaces(kMaterials), SurfacePair<Real>, LinearPair<Real>>;
  HOOKE_HD Pair lookup(const P& material) const { return load_pairs<Real, kMaterials>(pairs, first + material); }
  const PairRow<Real>* pairs;
  P first;
};
template <class Real>
struct PairTable<Real, Materials::one> {
  using P = Pack<Real>;
  using Pair = UniformPair<Real>;
  HOOKE_HD PairTable(const ForcePass<Real>& pass, const P&) : only(*pass.rules.pairs) {}
  HOOKE_HD Pair lookup(const P&) const { return {{}, P(only.contact_distance)}; }
  const PairRow<Real>& only;
};
template <class Real>
struct PairTable<Real, Materials::few> {
  using P = Pack<Real>;
  using Pair = LinearPair<Real>;
  HOOKE_HD PairTable(const ForcePass<Real>& pass, const P& material)
      : first(material * P(static_cast<Real>(pass.rules.material_count))),
        stiffness(pass.rules.few->stiffness),
        shear(pass.rules.few->shear),
        damping(pass.rules.few->damping),
        contact_distance(pass.rules.few->contact_distance) {}
  HOOKE_HD Pair lookup(const P& material) const {
    const P at = first + material;
    return {{stiffness.lookup(at), shear.lookup(at), damping.lookup(at)}, contact_distance.lookup(at)};
  }
  P first;
  SmallTable<Real> stiffness, shear, damping, contact_distance;
};
template <class Real>
struct PairTable<Real, Materials::few_surfaces> {
  using P = Pack<Real>;
  using Pair = SurfacePair<Real>;
  HOOKE_HD PairTable(const ForcePass<Real>& pass, const P& material)
      : linear(pass, material),
        friction(pass.rules.few->friction),
        tension(pass.rules.few->tension),
        cohesion(pass.rules.few->cohesion),
        range(pass.rules.few->range) {}
  HOOKE_HD Pair lookup(const P& material) const {
    const LinearPair<Real> pair = linear.lookup(material);
    const P at = linear.first + material;
    return {{pair.law, {friction.lookup(at), tension.lookup(at), cohesion.lookup(at), range.lookup(at)}},
            pair.contact_distance};
  }
  PairTable<Real, Materials::few> linear;
  SmallTable<Real> friction, tension, cohesion, range;
};

// The laws between the lanes' particles and walls.
template <class Real, Materials kMaterials>
HOOKE_HD auto wall_pairs_of(const ForcePass<Real>& pass, const Lanes<Real>& own) {
  using P = Pack<Real>;
  if constexpr (kMaterials == Materials::one) {
    const PairRow<Real>& m = *pass.rules.wall_pairs;
    return LinearPair<Real>{{P(m.stiffness), P(m.shear), P(m.damping)}, P(m.contact_distance)};
  } else {
    return load_pairs<Real, kMaterials>(pass.rules.wall_pairs, own.material);
  }
}

// Inverse mass, drag and mass of the lanes' particles.
template <class Real, Materials kMaterials>
HOOKE_HD Quad<Real> body_of(const ForcePass<Real>& pass, const Lanes<Real>& own) {
  using P = Pack<Real>;
  if constexpr (kMaterials == Materials::one) {
    const MaterialRow<Real>& m = pass.rules.materials[0];
    return {P(m.inverse_mass), P(m.drag), P(m.mass), P(Real(0))};
  } else if constexpr (are_few(kMaterials)) {
    const auto column = [&](const Real* of) { return SmallTable<Real>(of).lookup(own.material); };
    return {column(pass.rules.few->inverse_mass), column(pass.rules.few->drag), column(pass.rules.few->mass),
            P(Real(0))};
  } else {
    return load_quads(Real{}, [&](int lane) {
      return reinterpret_cast<const Real*>(pass.rules.materials + static_cast<std::size_t>(own.material.v[lane]));
    });
  }
}

template <class Real>
HOOKE_HD void add_where(const Mask<Real>& m, Vec3<Pack<Real>>& sum, const Vec3<Pack<Real>>& b) {
  sum = {add_where(m, sum.x, b.x), add_where(m, sum.y, b.y), add_where(m, sum.z, b.z)};
}
template <class Real>
HOOKE_HD Vec3<Pack<Real>> only_where(const Mask<Real>& m, const Vec3<Pack<Real>>& a) {
  return {only_where(m, a.x), only_where(m, a.y), only_where(m, a.z)};
}

// The sums over contacts of the lanes' particles with others. With one material, they are taken before its coefficients
// are applied. Without surfaces, pairs that do not act add 0.
template <class Real, Materials kMaterials, bool = have_surfaces(kMaterials)>
struct Contacts {
  using P = Pack<Real>;
  ContactForces<P> sum;

  HOOKE_HD void add(const ContactVectors<P>& contact, const ContactCoefficients<P>& law) {
    sum += contact_forces(contact, law);
  }
  HOOKE_HD ContactForces<P> forces(const ForcePass<Real>&) const { return sum; }
};
template <class Real>
struct Contacts<Real, Materials::one, false> {
  using P = Pack<Real>;
  ContactVectors<P> sum;

  HOOKE_HD void add(const ContactVectors<P>& contact, UniformLaw) { sum += contact; }
  HOOKE_HD ContactForces<P> forces(const ForcePass<Real>& pass) const {
    const PairRow<Real>& pair = *pass.rules.pairs;
    return contact_forces(sum, ContactCoefficients<P>{P(pair.stiffness), P(pair.shear), P(pair.damping)});
  }
};
template <class Real, Materials kMaterials>
struct Contacts<Real, kMaterials, true> {
  using P = Pack<Real>;
  SurfaceForces<P> sum;

  HOOKE_HD void add(const Mask<Real>& acting, const SurfaceForces<P>& forces) {
    add_where(acting, sum.linear.spring, forces.linear.spring);
    add_where(acting, sum.linear.shear, forces.linear.shear);
    add_where(acting, sum.linear.damping, forces.linear.damping);
    add_where(acting, sum.friction, forces.friction);
  }
  HOOKE_HD SurfaceForces<P> forces(const ForcePass<Real>&) const { return sum; }
};

// Mask of lanes whose pair acts at this overlap: the two touch, or cohesion reaches across the gap.
template <class Real>
HOOKE_HD Mask<Real> acts(const Pack<Real>& overlap, const ContactCoefficients<Pack<Real>>&) {
  return overlap > Pack<Real>(Real(0));
}
template <class Real>
HOOKE_HD Mask<Real> acts(const Pack<Real>& overlap, UniformLaw) {
  return overlap > Pack<Real>(Real(0));
}
template <class Real>
HOOKE_HD Mask<Real> acts(const Pack<Real>& overlap, const ContactLaw<Pack<Real>>& law) {
  return overlap > -law.surface.range;
}
