// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Contacts with colliders: a part of force_pass.inl, which includes it inside of the instruction set's namespace.

// Mask of lanes inside of a box.
template <class Real>
HOOKE_HD Mask<Real> is_inside(const Vec3<Pack<Real>>& x, const Vec3<Real>& from, const Vec3<Real>& to) {
  using P = Pack<Real>;
  return (x.x > P(from.x)) & (x.y > P(from.y)) & (x.z > P(from.z)) & (x.x < P(to.x)) & (x.y < P(to.y)) &
         (x.z < P(to.z));
}

// All colliders near the lanes' particles, in the scene's order, image by image. The first look tells whether any can
// be touched; what follows is no part of the loop that everybody runs, and so not inlined into it.
template <class Real, Materials kMaterials>
struct ColliderLoop {
  using P = Pack<Real>;
  const ForcePass<Real>& pass;
  const Lanes<Real>& own;
  const Mask<Real>& present;

  // The force of all of them, and whether there is one.
  HOOKE_HD Vec3<P> run(Mask<Real>& too_fast, bool& touched) const {
    Vec3<P> force{P(Real(0)), P(Real(0)), P(Real(0))};
    if (pass.collider_count == 0) return force;
    if (any(present & is_inside(own.x, pass.near_colliders_from, pass.near_colliders_to))) {
      // With copies: what a function is given by reference lies in memory from its start, whether it is called or not.
      const Lanes<Real> own_copy = own;
      const Mask<Real> present_copy = present;
      Mask<Real> fast = too_fast;
      touched = ColliderLoop{pass, own_copy, present_copy}.meet(fast, force);
      too_fast = fast;
    }
    return force;
  }

 private:
  // Whether any lane touches any collider.
  __attribute__((noinline)) bool meet(Mask<Real>& too_fast, Vec3<P>& force) const {
    bool touched = false;
    for (std::size_t c = 0; c < pass.collider_count; ++c) {
      const PlacedCollider<Real>& collider = pass.colliders[c];
      const Mask<Real> near = present & is_inside(own.x, collider.near_from, collider.near_to);
      if (!any(near)) continue;
      const auto pair = load_pairs<Real, kMaterials>(
          pass.collider_pairs + std::size_t{pass.collider_of[c]} * pass.material_count, own.material);
      for_each_collider_face(collider, own.x, [&](const ColliderFace<P>& face) {
        const P overlap = pair.reach - face.distance;
        const Mask<Real> here = near & acts<Real>(overlap, pair.law);
        if (!any(here)) return;
        touched = true;
        const Vec3<P> w = face.velocity - own.v;
        add_where(here, force, contact_forces(overlap, face.normal, w, pair.law).total());
        too_fast = too_fast | (here & (dot(w, face.normal) > P(pass.speed_limit)));
      });
    }
    return touched;
  }
};
