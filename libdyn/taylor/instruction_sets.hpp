#pragma once
/// Instruction sets that lanes are compiled for: what every processor has, AVX2 and AVX-512,
/// without those that the build leaves out (WHIRL_INSTRUCTION_SETS). Comes before headers of
/// Highway.

#ifdef WHIRL_WITHOUT_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | WHIRL_WITHOUT_TARGETS)
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#endif

/// Of the set that is being compiled: what every processor has are no registers that lanes would
/// fill, and motions go one after the other.
#define WHIRL_HAS_NO_LANES (HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SCALAR)
