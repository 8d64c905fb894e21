#pragma once

/// Put before a function whose loop counts bits: the compiler makes a second version with the POPCNT
/// instruction, and the dynamic linker picks one at start-up. Not with sanitizers (their run-time is not
/// ready when the choice is made) nor with compilers that lack it. Both versions give the same results.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define STDC_POPCNT_VERSIONS __attribute__((target_clones("popcnt", "default")))
#else
#define STDC_POPCNT_VERSIONS
#endif
