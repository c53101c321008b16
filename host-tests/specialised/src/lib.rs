//! Tests of many specialised functions, which take longer to compile than to run: a package of
//! their own, so that a change of other tests does not compile them.
