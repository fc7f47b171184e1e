//! Loops over the many numbers of one large body, split among all cores. The parts of a loop depend only on its length,
//! and no sum runs across parts, so that the number of threads changes no bit. Without the feature `batch`, one thread
//! runs the loops.

/// How many numbers of a vector or a state a thread handles at a time, which is some ten microseconds of memory
/// traffic. A shorter loop stays on one thread.
#[cfg(feature = "batch")]
pub(super) const GRAIN: usize = 1 << 15;

/// Whether a body with this number of coordinates is stepped on all cores.
#[cfg(feature = "lab")]
pub(super) fn is_large(coordinates: usize) -> bool {
    coordinates > GRAIN / 2
}

/// Runs `work` on a worker of rayon's pool, because a nested [`split`] from outside the pool would inject work, which
/// allocates.
#[cfg(feature = "lab")]
pub(super) fn on_worker(work: &mut (dyn FnMut() + Send)) {
    rayon::join(work, || ());
}

/// Runs `work`, splitting it for as long as `halve` succeeds. A half moves to another core if another core is free.
#[cfg(feature = "batch")]
pub(super) fn split<W: Send>(
    work: W,
    halve: impl Fn(W) -> Result<[W; 2], W> + Copy + Sync + Send,
    run: impl Fn(W) + Copy + Sync + Send,
) {
    match halve(work) {
        Ok([near, far]) => {
            rayon::join(|| split(near, halve, run), || split(far, halve, run));
        }
        Err(whole) => run(whole),
    }
}

/// Checks that a system's vector still has the length that the system started with.
///
/// # Panics
/// If the lengths differ.
#[inline]
pub(super) fn assert_length(found: usize, wanted: usize) {
    if found != wanted {
        other_length(found, wanted);
    }
}

#[cold]
fn other_length(found: usize, wanted: usize) -> ! {
    panic!(
        "a vector of {found} numbers meets one of {wanted}: all vectors of a system keep the length of its first \
         state; `acceleration` must overwrite the numbers of `a`, not replace `a` by another `Vec`"
    )
}

/// Runs `work` on equal parts of vectors of one length. It writes the parts of `to` and reads the parts of `from`.
///
/// # Panics
/// If the lengths of the vectors differ.
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
        return split((to, from), halves, |(to, from)| work(to, from));
    }
    work(to, from);
}

/// Vectors to write, and vectors to read.
#[cfg(feature = "batch")]
type Vectors<'a, const M: usize, const N: usize> = ([&'a mut [f64]; M], [&'a [f64]; N]);

/// Splits vectors that are longer than a [`GRAIN`] into halves. Returns shorter vectors as the error.
#[cfg(feature = "batch")]
fn halves<const M: usize, const N: usize>(
    (to, from): Vectors<'_, M, N>,
) -> Result<[Vectors<'_, M, N>; 2], Vectors<'_, M, N>> {
    if to[0].len() <= GRAIN {
        return Err((to, from));
    }
    let middle = to[0].len() / 2;
    let [mut to_near, mut to_far] = [(); 2].map(|()| [(); M].map(|()| &mut [][..]));
    for (place, to) in to.into_iter().enumerate() {
        (to_near[place], to_far[place]) = to.split_at_mut(middle);
    }
    let (near, far) = (from.map(|from| &from[..middle]), from.map(|from| &from[middle..]));
    Ok([(to_near, near), (to_far, far)])
}
