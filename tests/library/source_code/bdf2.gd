# BDF2 (bdf2): stable at any step, and takes less energy than implicit Euler for the same work.
# Source: Curtiss & Hirschfelder, Integration of stiff equations (1952); started by Alexander,
# Diagonally implicit Runge-Kutta methods for stiff ODEs (1977), the SDIRK of two stages.
#
# Order: 2, with drag too. Evaluations per step: as many as it needs.
# Stability: an undamped spring stays bounded at any step.
# Symplectic: no. Reversible: no.
# Memory: one for each coordinate. The first step and one of another length restart it by a step
# of Alexander's two-stage SDIRK, which damps as much and has the same order. Make a new one after
# a jump of x, v or the forces.
# Beware: the damping that it adds is its error and depends on the step, so that another tick rate
# is another feel.
# Newton's iteration solves each step, with slopes by differences; where it does not converge, x
# and v become NaN.
#
# x, v: position and velocity of one coordinate; for several that feel each other, slopes are
# matrices and a division is the solution of a linear system.
# h: the step, in seconds.
# a(x, v): the acceleration at position x and velocity v.
# Forces that depend on time: a is not told it; hold them for the step at their value at its end,
# t + h; the order is then 2 at most.
# Returns [x, v].

class Bdf2Memory:
	var last_h: float = NAN
	var before_x: float = 0.0
	var before_v: float = 0.0

# Solves s = a(x + alpha s, v + beta s) by Newton's iteration, to round-off; NaN if 30 iterations do
# not solve it. The slope is a difference quotient; with formulas for the derivatives of a it is
# alpha da/dx + beta da/dv.
static func bdf2_solve(a: Callable, x: float, v: float, alpha: float, beta: float) -> float:
	if beta == 0.0:
		return a.call(x, v)
	var far_v: float = absf(v / beta)
	var far_x: float = absf(x / alpha)
	var s: float = 0.0
	var n: int = 0
	while n < 30:
		n += 1
		var found: float = a.call(x + alpha * s, v + beta * s)
		var near: float = maxf(maxf(absf(found), absf(s)), far_v)
		var other: float = s + maxf(maxf(6e-6 * near, 1e-11 * far_x), 1e-150)
		var slope: float = (a.call(x + alpha * other, v + beta * other) - found) / (other - s)
		var residual: float = found - s
		s += residual / (1.0 - slope)
		# The residual was at rounding level before this correction.
		if absf(residual) <= 4e-15 * (absf(found) + absf(slope) * maxf(far_v, far_x)):
			return s
	return NAN

static func bdf2(memory: Bdf2Memory, x: float, v: float, h: float, a: Callable) -> Array:
	if h == 0.0:
		return [x, v]
	var from_x: float = x + 1.0 / 3.0 * x + -1.0 / 3.0 * memory.before_x
	var from_v: float = v + 1.0 / 3.0 * v + -1.0 / 3.0 * memory.before_v
	var c: float = h * 2.0 / 3.0
	if memory.last_h != h:
		# The first step is one of Alexander's two-stage SDIRK; its diagonal is 1 - 1 / sqrt(2).
		# The end is 1 + sqrt(2) times as far as the stage.
		c = h * 0.2928932188134524
		var a_stage: float = bdf2_solve(a, x + c * v, v, c * c, c)
		var stage_v: float = v + c * a_stage
		var stage_x: float = x + c * stage_v
		from_x = x + 2.414213562373096 * stage_x + -2.414213562373096 * x
		from_v = v + 2.414213562373096 * stage_v + -2.414213562373096 * v
	memory.before_x = x
	memory.before_v = v
	var a_end: float = bdf2_solve(a, from_x + c * from_v, from_v, c * c, c)
	v = from_v + c * a_end
	x = from_x + c * v
	memory.last_h = h
	return [x, v]
