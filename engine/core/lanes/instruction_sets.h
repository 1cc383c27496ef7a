// The scheme of loops that are built for several instruction sets, and what this processor has.
//
//   lanes   float_lanes.h, byte_lanes.h: as many numbers side by side as the including file's
//           instruction set holds, from one source by the compilers' vector extension
//   loops   of a room, *_loops.h: written on lanes, or plainly for the compiler to vectorise
//   table   of a room, *_loops_table.h: its loops as one struct of functions
//   files   *_loops.cpp is built for every processor; *_loops_avx2.cpp and *_loops_avx512.cpp hold
//           the same table built with those instructions (CMakeLists.txt), or null
//   choice  in *_loops.cpp, at run time, by Has()
//
// Lanes, loops and tables lie in unnamed namespaces, so that each file has its own, and call no
// inline function of any other header: the linker keeps one copy of such a function, perhaps the
// one that the processor at hand cannot run. All sets give the same bits: each lane rounds and
// wraps as a lone number does, and no multiplication is contracted with an addition.
#pragma once

namespace palace {

enum class InstructionSet { kAvx2, kAvx512 };

/// False on every processor that is no x86-64.
bool Has(InstructionSet set);

}  // namespace palace
