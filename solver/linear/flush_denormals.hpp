// Denormal numbers cost a hundred cycles each and arise wherever a correction decays over empty cells.
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace granvof::linear {

// While it lives, results and operands too small to matter count as zero in this thread.
class FlushDenormals {
 public:
#if defined(__SSE2__)
  FlushDenormals() : previous_(_mm_getcsr()) {
    _mm_setcsr(previous_ | 0x8040U);
  }
  ~FlushDenormals() {
    _mm_setcsr(previous_);
  }

 private:
  unsigned previous_;

 public:
#else
  FlushDenormals() {}
  ~FlushDenormals() {}
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals(FlushDenormals&&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;
  FlushDenormals& operator=(FlushDenormals&&) = delete;
};

}  // namespace granvof::linear
