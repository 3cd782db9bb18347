//! Numbers: the number trait, stable angles, units in the last place, dual numbers, input points.
