/// A pack from its settings to its measures.
#pragma once

#include "engine/kernel/run.inl"

namespace portrait::PORTRAIT_ISA_NAME {

template <PlantKind plant, bool filtered, bool disturbed>
__attribute__((noinline)) void run_step(const Pack& pack, StepMeters& w, StepMeters& d, Lanes& dead_times) {
  Run<plant, filtered, disturbed> run(pack, w, d);
  run.to_horizon();
  dead_times = max(dead_times, run.dead_times);
}

inline void store_step(StepMeters& m, kernel::StepColumns& c) {
  m.evaluate();
  m.e.iae().to(c.iae), m.e.ise().to(c.ise), m.e.itae().to(c.itae), m.e.itse().to(c.itse);
  m.y.variation().to(c.tv_y), m.y.deviation0().to(c.tv0_y), m.y.deviation1().to(c.tv1_y);
  m.y.deviation2().to(c.tv2_y), m.y.largest().to(c.y_max);
  m.u.variation().to(c.tv_u), m.u.deviation0().to(c.tv0_u), m.u.deviation1().to(c.tv1_u);
  m.u.deviation2().to(c.tv2_u), m.u.largest().to(c.u_max);
}

template <PlantKind plant, bool filtered>
void run_family(const Pack& pack, PackResult& result) {
  Queues queues;
  StepMeters w, d;
  Lanes dead_times = 0.0;
  w.begin(Lanes::from(pack.y_rest_w), Lanes::from(pack.u_rest_w), 1, scale_of_setpoint(pack), queues);
  d.begin(Lanes::from(pack.y_rest_d), Lanes::from(pack.u_rest_d), 0, 1.0, queues);
  if (pack.samples) begin_samples(pack);
  run_step<plant, filtered, true>(pack, w, d, dead_times);
  if (pack.setpoint_run != SetpointRun::from_disturbance) run_step<plant, filtered, false>(pack, w, d, dead_times);
  dead_times.to(result.dead_times);
  store_step(w, result.w);
  store_step(d, result.d);
  Lanes late = 0.0, tail = 0.0, smooth_tail = 0.0;
  const ShapeMeter* meters[] = {&w.y, &w.u, &d.y, &d.u};
  for (const ShapeMeter* m : meters) {
    late = max(late, m->late_part());
    tail = max(tail, m->tail_part());
    smooth_tail = max(smooth_tail, m->smooth_tail_part());
  }
  late.to(result.late);
  tail.to(result.tail);
  smooth_tail.to(result.smooth_tail);
}

inline void run(const Pack& pack, PackResult& result) {
  const bool filtered = pack.n > 0;
  switch (pack.plant) {
    case PlantKind::dipdt:
      return filtered ? run_family<PlantKind::dipdt, true>(pack, result)
                      : run_family<PlantKind::dipdt, false>(pack, result);
    case PlantKind::ipdt:
      return filtered ? run_family<PlantKind::ipdt, true>(pack, result)
                      : run_family<PlantKind::ipdt, false>(pack, result);
    case PlantKind::fotd:
      return filtered ? run_family<PlantKind::fotd, true>(pack, result)
                      : run_family<PlantKind::fotd, false>(pack, result);
    case PlantKind::cascade:
      return filtered ? run_family<PlantKind::cascade, true>(pack, result)
                      : run_family<PlantKind::cascade, false>(pack, result);
  }
}

}  // namespace portrait::PORTRAIT_ISA_NAME
