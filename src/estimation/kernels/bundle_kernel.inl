// Residuals and derivatives of a bundle adjustment. Included by the kernel sources only, inside of their
// namespace.

/// Four points in their cameras.
struct BundleProjection {
  Lanes row[3][3];        ///< rotations
  Lanes offset[3];        ///< point minus centre
  Lanes x, y, inverse_z;  ///< point over z, and 1 / z
  Lanes in_front;         ///< 1 or 0
};

STDC_INLINE void project_bundle(const BundlePacket& packet, const BundleView* views,
                                const BundlePoint* points, BundleProjection* out) {
  const std::int32_t *pose = packet.pose, *point = packet.point;
  Lanes position[4], in_camera[3];
  transpose(load(points[point[0]].position), load(points[point[1]].position), load(points[point[2]].position),
            load(points[point[3]].position), position);
  Lanes view[3][4];
  for (int r = 0; r < 3; ++r) {
    transpose(load(views[pose[0]].rows[r]), load(views[pose[1]].rows[r]), load(views[pose[2]].rows[r]),
              load(views[pose[3]].rows[r]), view[r]);
  }
  for (int r = 0; r < 3; ++r) out->offset[r] = position[r] - view[r][3];
  for (int r = 0; r < 3; ++r) {
    in_camera[r] = view[r][0] * out->offset[0] + view[r][1] * out->offset[1] + view[r][2] * out->offset[2];
    for (int c = 0; c < 3; ++c) out->row[r][c] = view[r][c];
  }
  const Lanes z = in_camera[2];
  out->in_front = z > kNearestDepth ? all(1.0) : all(0.0);
  out->inverse_z = 1.0 / (z > kNearestDepth ? z : all(1.0));
  out->x = in_camera[0] * out->inverse_z;
  out->y = in_camera[1] * out->inverse_z;
}

/// Residuals in units of their sigmas.
struct BundleResiduals {
  Lanes u, v, depth;
};

STDC_INLINE void bundle_residuals(const BundlePacket& packet, const BundleProjection& at,
                                  const Intrinsics& camera, const Lanes& inverse_sigma,
                                  const Lanes& depth_weight, BundleResiduals* out) {
  out->u = (camera.fx * at.x + camera.cx - load(packet.u)) * inverse_sigma;
  out->v = (camera.fy * at.y + camera.cy - load(packet.v)) * inverse_sigma;
  out->depth = (at.inverse_z - load(packet.inverse_depth)) * depth_weight;
}

/// Adds weight * row * (row, residual) to the nine sums of a term.
STDC_INLINE void add_term(const Lanes (&row)[3], const Lanes& weight, const Lanes& residual, Lanes* sums) {
  int k = 0;
  for (int i = 0; i < 3; ++i) {
    const Lanes weighted = weight * row[i];
    for (int j = i; j < 3; ++j, ++k) sums[k] += weighted * row[j];
    sums[6 + i] += weighted * residual;
  }
}

double linearise_bundle(const BundlePacket* packets, std::size_t count, const BundleView* views,
                        const BundlePoint* points, const Intrinsics& camera, BundleTerm* terms) {
  Lanes total = all(0.0);
  for (std::size_t n = 0; n < count; ++n) {
    BundleProjection at;
    BundleResiduals e;
    project_bundle(packets[n], views, points, &at);
    const Lanes inverse_sigma = load(packets[n].used_inverse_sigma), c = load(packets[n].used_depth_weight);
    bundle_residuals(packets[n], at, camera, inverse_sigma, c, &e);
    Lanes pixel_weight, pixel_cost, depth_weight, depth_cost;
    huber(e.u * e.u + e.v * e.v, kPixelBend, &pixel_weight, &pixel_cost);
    huber(e.depth * e.depth, kDepthBend, &depth_weight, &depth_cost);
    const Lanes behind_cost = inverse_sigma > 0.0 ? all(kBehindCost) : all(0.0);
    total += at.in_front > 0.0 ? pixel_cost + depth_cost : behind_cost;
    pixel_weight *= at.in_front;
    depth_weight *= at.in_front;

    const Lanes a = camera.fx * inverse_sigma * at.inverse_z, b = camera.fy * inverse_sigma * at.inverse_z;
    const Lanes d = -c * at.inverse_z * at.inverse_z;
    Lanes u_row[3], v_row[3], d_row[3];
    for (int k = 0; k < 3; ++k) {
      u_row[k] = a * (at.row[0][k] - at.x * at.row[2][k]);
      v_row[k] = b * (at.row[1][k] - at.y * at.row[2][k]);
      d_row[k] = d * at.row[2][k];
    }
    Lanes sums[9] = {};
    add_term(u_row, pixel_weight, e.u, sums);
    add_term(v_row, pixel_weight, e.v, sums);
    add_term(d_row, depth_weight, e.depth, sums);
    for (int k = 0; k < 6; ++k) store(terms[n].hessian[k], sums[k]);
    for (int k = 0; k < 3; ++k) store(terms[n].gradient[k], sums[6 + k]);
    for (int k = 0; k < 3; ++k) store(terms[n].offset[k], at.offset[k]);
  }
  return 0.5 * sum(total);
}

double classify_bundle(BundlePacket* packets, std::size_t count, const BundleView* views,
                       const BundlePoint* points, const Intrinsics& camera, const Gate& gate) {
  Lanes total = all(0.0);
  for (std::size_t n = 0; n < count; ++n) {
    BundlePacket& packet = packets[n];
    BundleProjection at;
    BundleResiduals e;
    project_bundle(packet, views, points, &at);
    const Lanes inverse_sigma = load(packet.inverse_sigma), depth_weight = load(packet.depth_weight);
    bundle_residuals(packet, at, camera, inverse_sigma, depth_weight, &e);
    const Lanes pixel = e.u * e.u + e.v * e.v, depth = e.depth * e.depth;
    Lanes weight, pixel_cost, depth_cost;
    huber(pixel, kPixelBend, &weight, &pixel_cost);
    huber(depth, kDepthBend, &weight, &depth_cost);
    const Lanes behind_cost = inverse_sigma > 0.0 ? all(kBehindCost) : all(0.0);
    total += at.in_front > 0.0 ? pixel_cost + depth_cost : behind_cost;
    for (int l = 0; l < kLanes; ++l) {
      const bool agrees = at.in_front[l] > 0 && pixel[l] <= gate.pixel;
      packet.used_inverse_sigma[l] = agrees ? packet.inverse_sigma[l] : 0.0F;
      packet.pixel_chi_square[l] = static_cast<float>(pixel[l]);
      packet.depth_chi_square[l] = static_cast<float>(depth[l]);
      packet.used_depth_weight[l] = agrees && depth[l] <= gate.depth ? packet.depth_weight[l] : 0.0F;
    }
  }
  return 0.5 * sum(total);
}
