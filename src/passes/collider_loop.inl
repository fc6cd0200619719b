// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Contacts with colliders: a part of force_pass.inl, which includes it inside of the instruction set's namespace.

// Mask of lanes inside of a box.
template <class Real>
HOOKE_HD Mask<Real> is_inside(const Vec3<Pack<Real>>& x, const Box3<Real>& box) {
  using P = Pack<Real>;
  return (x.x > P(box.min.x)) & (x.y > P(box.min.y)) & (x.z > P(box.min.z)) & (x.x < P(box.max.x)) &
         (x.y < P(box.max.y)) & (x.z < P(box.max.z));
}

// All colliders near the lanes' particles, in the scene's order, image by image. A first test tells whether any can be
// touched. The rest is not inlined into the loop that every pack runs.
template <class Real, Materials kMaterials>
struct ColliderLoop {
  using P = Pack<Real>;
  const ForcePass<Real>& pass;
  const Lanes<Real>& own;
  const Mask<Real>& present;

  // The force of all colliders, and whether one acts.
  HOOKE_HD Vec3<P> run(Mask<Real>& too_fast, bool& touched) const {
    Vec3<P> force{P(Real(0)), P(Real(0)), P(Real(0))};
    if (pass.colliders.count == 0) return force;
    if (any(present & is_inside(own.x, pass.colliders.near))) {
      // Copies, as data passed by reference lies in memory from its start, whether the function is called or not.
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
  HOOKE_HD_APART bool meet(Mask<Real>& too_fast, Vec3<P>& force) const {
    bool touched = false;
    for (std::size_t c = 0; c < pass.colliders.count; ++c) {
      const PlacedCollider<Real>& collider = pass.colliders.placed[c];
      const Mask<Real> near = present & is_inside(own.x, collider.near);
      if (!any(near)) continue;
      const auto pair = load_pairs<Real, kMaterials>(
          pass.rules.collider_pairs + std::size_t{pass.colliders.index[c]} * pass.rules.material_count, own.material);
      for_each_collider_face(collider, own.x, [&](const ColliderFace<P>& face) {
        const P overlap = pair.contact_distance - face.distance;
        const Mask<Real> here = near & acts<Real>(overlap, pair.law);
        if (!any(here)) return;
        touched = true;
        const Vec3<P> w = face.velocity - own.v;
        add_where(here, force, contact_forces(overlap, face.normal, w, pair.law).total());
        too_fast = too_fast | (here & (magnitude(dot(w, face.normal)) > P(pass.rules.speed_limit)));
      });
    }
    return touched;
  }
};
