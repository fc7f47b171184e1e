//! The instruction sets of a processor for which blocks are compiled.

use multiversion::multiversion;
use multiversion::target::match_target;

/// Numbers of copies in a block, enough to fill one or two registers.
pub(super) const NARROW: usize = 4;
pub(super) const WIDE: usize = 8;

/// An instruction set for blocks of bodies. All sets give the same bits, because none fuses a product with a sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstructionSet {
    /// The baseline of the platform, which computes two numbers at once on x86-64 and on ARM.
    Portable,
    /// Computes four numbers at once.
    Avx2,
    /// Computes eight numbers at once.
    Avx512,
}

impl InstructionSet {
    /// All sets, narrowest first.
    pub const ALL: [Self; 3] = [Self::Portable, Self::Avx2, Self::Avx512];

    /// Returns the widest set that this processor has.
    pub fn widest() -> Self {
        let widest = Self::ALL.into_iter().rev().find(|set| set.is_available());
        widest.unwrap_or(Self::Portable)
    }

    /// Whether this processor has the set.
    pub fn is_available(self) -> bool {
        match self {
            Self::Portable => true,
            Self::Avx2 => has_avx2(),
            Self::Avx512 => has_avx512(),
        }
    }

    /// Returns the number of copies in a block of a compiled method.
    pub(super) const fn width(self) -> usize {
        match self {
            Self::Portable | Self::Avx2 => NARROW,
            Self::Avx512 => WIDE,
        }
    }

    /// Whether a loop over blocks of this width can run on the set. Every set runs a loop without a width, and the
    /// blocks of an interpreted law.
    const fn runs_blocks_of(self, width: Option<usize>) -> bool {
        match width {
            Some(width @ (NARROW | WIDE)) => width == self.width(),
            _ => true,
        }
    }

    /// Runs a loop compiled for this instruction set.
    ///
    /// # Panics
    /// If blocks of the loop's width do not run on this set.
    pub(crate) fn run<K: Kernel>(self, kernel: K) {
        // Compiles a loop only for the sets that it can run on.
        match self {
            Self::Portable if const { Self::Portable.runs_blocks_of(K::WIDTH) } => kernel.run(),
            Self::Avx2 if const { Self::Avx2.runs_blocks_of(K::WIDTH) } => with_avx2(kernel),
            Self::Avx512 if const { Self::Avx512.runs_blocks_of(K::WIDTH) } => with_avx512(kernel),
            _ => unreachable!("{self:?} takes no blocks of {:?}", K::WIDTH),
        }
    }
}

/// A loop to be compiled for an instruction set.
pub(crate) trait Kernel {
    /// Number of copies in a block of the loop; `None` if every instruction set can run the loop.
    const WIDTH: Option<usize> = None;

    /// Runs the loop. It must be inlined, with everything that is to be compiled for the same instruction set.
    fn run(self);
}

#[multiversion(targets("x86_64+avx+avx2"))]
fn with_avx2<K: Kernel>(kernel: K) {
    match_target! {
        "x86_64+avx+avx2" => kernel.run(),
        // Never runs, because the function is chosen only if the processor has the instructions.
        _ => {
            let _ = kernel;
            unreachable!()
        }
    }
}

#[multiversion(targets("x86_64+avx+avx2+avx512f+avx512vl"))]
fn with_avx512<K: Kernel>(kernel: K) {
    match_target! {
        "x86_64+avx+avx2+avx512f+avx512vl" => kernel.run(),
        // Never runs, because the function is chosen only if the processor has the instructions.
        _ => {
            let _ = kernel;
            unreachable!()
        }
    }
}

#[multiversion(targets("x86_64+avx+avx2"))]
fn has_avx2() -> bool {
    match_target! { "x86_64+avx+avx2" => true, _ => false }
}

#[multiversion(targets("x86_64+avx+avx2+avx512f+avx512vl"))]
fn has_avx512() -> bool {
    match_target! { "x86_64+avx+avx2+avx512f+avx512vl" => true, _ => false }
}
