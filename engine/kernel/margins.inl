/// Stability, peaks of the sensitivity functions and margins of a pack of open loops, each with one gain crossover or none.
///
///     stable  <=>  arg L(jw_c) > -pi, |L(jw_c)| = 1                                  engine/loop/stability.h
///     Ms = sup 1/|1 + L|,  Mt = sup 1/|1 + 1/L|
///
/// Without a crossover the loop is stable, and the march begins near omega = 0.
#pragma once

#include "engine/kernel/march.inl"

namespace portrait::PORTRAIT_ISA_NAME {

inline void find_margins(const kernel::MarginPack& pack, kernel::MarginResult& result) {
  const OpenLoopLanes loop(pack);
  const Gain gain(loop);
  Mask lost;
  const Lanes crossover = gain.crossover(lost), phase = loop.phase(crossover), room = phase + Lanes(kPi);
  const Mask bounded = gain.end() < Lanes(1.0), unbounded = !bounded;
  const Mask once = bounded & gain.crosses_once(), never = bounded & gain.never_crosses();
  const Mask stable = (but_not(once, lost) & (room > Lanes(0.0))) | never;
  const Limits limits(loop);
  March march(loop, gain, limits);
  if (any(stable)) march.run(select(once, crossover, loop.rest()), stable, stable & once);
  flags(but_not(unbounded | once | never, march.given_up | (once & lost))).to(result.known);
  flags(stable).to(result.stable);
  const Lanes degrees = (Lanes(kPi) - abs(phase)) * Lanes(180 / kPi);
  select(once, degrees, Lanes(kInfinity)).to(result.PM);
  select(once, room / crossover, Lanes(kInfinity)).to(result.DM);
  store_margins(march, result);
}

}  // namespace portrait::PORTRAIT_ISA_NAME
