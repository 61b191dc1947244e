// SPDX-License-Identifier: MIT
#include "polhode/perturb/facet_stream.hpp"

#include <algorithm>

namespace polhode {
inline namespace v0 {

StreamLaw light_law(const Finish& finish) {
  const double absorbed = 1.0 - finish.specular - finish.diffuse;
  return {1.0 - finish.specular, 2.0 * finish.specular,
          2.0 / 3.0 * (finish.diffuse + finish.emitted * absorbed)};
}

StreamLaw molecule_law(const Finish& finish) {
  const double n = finish.normal_accommodation, t = finish.tangential_accommodation;
  return {t, 2.0 - n - t, n};
}

FacetStream::FacetStream(const Surface& surface, StreamLaw (*law)(const Finish&))
    : surface_(surface) {
  rows_.reserve(surface.facets().size());
  for (const SurfaceFacet& f : surface.facets()) {
    const StreamLaw own = law(f.finish);
    rows_.push_back({f.normal, (f.area * own.along) * f.centre, f.area * cross(f.centre, f.normal),
                     own.mirrored, own.normal, f.area, f.area * own.along});
  }
  find_edges();
}

void FacetStream::find_edges() {
  for (Row& row : rows_) {
    const auto known = std::find_if(edges_.begin(), edges_.end(),
                                    [&](const Vec3& n) { return n == row.n || n == -row.n; });
    row.edge = static_cast<std::size_t>(known - edges_.begin());
    row.towards = known == edges_.end() || *known == row.n ? 1.0 : -1.0;
    if (known == edges_.end()) edges_.push_back(row.n);
    if (edges_.size() > most_edges) {
      edges_.clear();
      return;
    }
  }
}

}  // namespace v0
}  // namespace polhode
