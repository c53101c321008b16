//! Links that bend: laws, a finite-element referee, hard cases and a scene, in one program.

mod engine;
mod hard_cases;
mod laws;
mod referee;
mod scene;
