//! Claims about the fastest motions along taught paths: against TOPP-RA, within limits between grid
//! points, and played back after a hand has guided the arm. The tables of
//! `docs/guide/src/taught-paths.md` were measured here.

mod person;
mod playback;
mod toppra;
mod ur5e;
