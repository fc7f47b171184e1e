//! Long loops over the numbers of one large body, shared by all cores. The shares are cut by size alone, and no sum
//! passes from one to another, so that the number of threads changes no bit. Without the feature `batch` one does all.

/// The numbers of a vector that a thread takes at a time: some ten microseconds of memory. A vector of fewer is left to
/// one thread.
#[cfg(feature = "batch")]
const GRAIN: usize = 1 << 15;

/// Whether a body with this number of coordinates is stepped on all cores.
#[cfg(feature = "lab")]
pub(super) fn is_large(coordinates: usize) -> bool {
    coordinates > GRAIN / 2
}

/// Runs `work` once, on a thread of the pool that [`join`] shares work with. Never allocates there.
#[cfg(feature = "lab")]
pub(super) fn enter(work: &mut (dyn FnMut() + Send)) {
    join(work, || ());
}

/// Does both, at once if a core is free.
#[cfg(feature = "batch")]
pub(super) fn join<A: Send, B: Send>(
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    rayon::join(a, b)
}

/// Checks that a vector of a system has the length that the system began with.
///
/// # Panics
/// If it has not.
#[inline]
pub(super) fn assert_length(found: usize, wanted: usize) {
    if found != wanted {
        other_length(found, wanted);
    }
}

#[cold]
fn other_length(found: usize, wanted: usize) -> ! {
    panic!(
        "a vector of {found} numbers meets one of {wanted}: all vectors of a system keep the length of its first state; \
         `acceleration` overwrites the numbers of `a`, and does not replace `a` by another `Vec`"
    )
}

/// Does `work` on equal parts of vectors of one length: of those `to` write and `from` read.
///
/// # Panics
/// If their lengths differ.
#[inline]
pub(super) fn in_parts<const M: usize, const N: usize>(
    to: [&mut [f64]; M],
    from: [&[f64]; N],
    work: impl Fn([&mut [f64]; M], [&[f64]; N]) + Copy + Sync + Send,
) {
    to.iter().for_each(|to_one| assert_length(to_one.len(), to[0].len()));
    from.iter().for_each(|from| assert_length(from.len(), to[0].len()));
    #[cfg(feature = "batch")]
    if to[0].len() > GRAIN {
        return in_halves(to, from, work);
    }
    work(to, from);
}

#[cfg(feature = "batch")]
#[cold]
fn in_halves<const M: usize, const N: usize>(
    to: [&mut [f64]; M],
    from: [&[f64]; N],
    work: impl Fn([&mut [f64]; M], [&[f64]; N]) + Copy + Sync + Send,
) {
    let middle = to[0].len() / 2;
    let [mut to_near, mut to_far] = [(); 2].map(|()| [(); M].map(|()| &mut [][..]));
    for (place, to) in to.into_iter().enumerate() {
        (to_near[place], to_far[place]) = to.split_at_mut(middle);
    }
    let (near, far) = (from.map(|from| &from[..middle]), from.map(|from| &from[middle..]));
    join(|| in_parts(to_near, near, work), || in_parts(to_far, far, work));
}
