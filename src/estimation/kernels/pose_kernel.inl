// The linearisation of the pose-only problem. Included by the kernel sources only, inside of their namespace.

/// Where four landmarks are seen, relative to the measurements and in units of their sigmas.
struct PoseResiduals {
  Lanes x, y, inverse_z;  ///< point over z, and 1 / z
  Lanes u, v, depth;      ///< residuals
  Lanes in_front;         ///< 1 or 0
};

STDC_INLINE void pose_residuals(const PosePacket& packet, const PinholeView& view, PoseResiduals* out) {
  const double* r = view.rotation;
  const Lanes x = load(packet.x), y = load(packet.y), z = load(packet.z);
  const Lanes px = r[0] * x + r[1] * y + r[2] * z + view.translation[0];
  const Lanes py = r[3] * x + r[4] * y + r[5] * z + view.translation[1];
  const Lanes pz = r[6] * x + r[7] * y + r[8] * z + view.translation[2];
  out->in_front = pz > kNearestDepth ? all(1.0) : all(0.0);
  out->inverse_z = 1.0 / (pz > kNearestDepth ? pz : all(1.0));
  out->x = px * out->inverse_z;
  out->y = py * out->inverse_z;
  const Lanes inverse_sigma = load(packet.inverse_sigma);
  out->u = (view.fx * out->x + view.cx - load(packet.u)) * inverse_sigma;
  out->v = (view.fy * out->y + view.cy - load(packet.v)) * inverse_sigma;
  out->depth = (out->inverse_z - load(packet.inverse_depth)) * load(packet.depth_weight);
}

STDC_INLINE void pose_classify(const PoseResiduals& e, const Gate& gate, PosePacket* packet) {
  const Lanes present = load(packet->inverse_sigma) > 0.0 ? e.in_front : all(0.0);
  const Lanes pixel = e.u * e.u + e.v * e.v <= gate.pixel ? present : all(0.0);
  const Lanes near = e.depth * e.depth <= gate.depth ? pixel : all(0.0);
  store(packet->use_pixel, pixel);
  store(packet->use_depth, load(packet->depth_weight) > 0.0 ? near : all(0.0));
}

/// Adds w * row * (row, residual) to the 27 sums of H and g; `row`: only the entries in the given columns,
/// the others are 0.
template <int... columns>
STDC_INLINE void add_row(const Lanes (&row)[sizeof...(columns)], const Lanes& weight, const Lanes& residual,
                         Lanes* sums) {
  constexpr int kColumn[] = {columns...}, kCount = sizeof...(columns);
#pragma GCC unroll 6
  for (int a = 0; a < kCount; ++a) {
    const int i = kColumn[a];
    const Lanes weighted = weight * row[a];
#pragma GCC unroll 6
    for (int b = a; b < kCount; ++b) sums[i * (11 - i) / 2 + kColumn[b]] += weighted * row[b];
    sums[21 + i] += weighted * residual;
  }
}

STDC_INLINE void add_pose_packet(const PosePacket& packet, const PinholeView& view, const PoseResiduals& e,
                                 Lanes* sums) {
  Lanes pixel_weight, pixel_cost, depth_weight, depth_cost;
  huber(e.u * e.u + e.v * e.v, kPixelBend, &pixel_weight, &pixel_cost);
  huber(e.depth * e.depth, kDepthBend, &depth_weight, &depth_cost);
  const Lanes use_pixel = load(packet.use_pixel), use_depth = load(packet.use_depth);
  const Lanes cost = pixel_cost * use_pixel + depth_cost * use_depth;
  sums[27] += e.in_front > 0.0 ? cost : kBehindCost * use_pixel;
  pixel_weight *= use_pixel * e.in_front;
  depth_weight *= use_depth * e.in_front;

  const Lanes inverse_sigma = load(packet.inverse_sigma);
  const Lanes a = view.fx * inverse_sigma, b = view.fy * inverse_sigma, c = load(packet.depth_weight);
  const Lanes xy = e.x * e.y;
  const Lanes u_row[] = {a * e.inverse_z, -a * e.x * e.inverse_z, -a * xy, a * (1.0 + e.x * e.x), -a * e.y};
  const Lanes v_row[] = {b * e.inverse_z, -b * e.y * e.inverse_z, -b * (1.0 + e.y * e.y), b * xy, b * e.x};
  const Lanes d = -c * e.inverse_z;  // d(1/z) = -dz / z^2, dz = (0, 0, 1, y, -x, 0)
  const Lanes d_row[] = {d * e.inverse_z, d * e.y, -d * e.x};
  add_row<0, 2, 3, 4, 5>(u_row, pixel_weight, e.u, sums);
  add_row<1, 2, 3, 4, 5>(v_row, pixel_weight, e.v, sums);
  add_row<2, 3, 4>(d_row, depth_weight, e.depth, sums);
}

void linearise_pose(PosePacket* packets, std::size_t count, const PinholeView& view, const Gate* gate,
                    PoseSystem* system) {
  Lanes sums[28] = {};
  for (std::size_t i = 0; i < count; ++i) {
    PoseResiduals residuals;
    pose_residuals(packets[i], view, &residuals);
    if (gate != nullptr) pose_classify(residuals, *gate, &packets[i]);
    add_pose_packet(packets[i], view, residuals, sums);
  }
  for (int k = 0; k < 21; ++k) system->h[k] = sum(sums[k]);
  for (int k = 0; k < 6; ++k) system->g[k] = sum(sums[21 + k]);
  system->cost = 0.5 * sum(sums[27]);
}
