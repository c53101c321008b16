//! The library in the browser: what the page calls, compiled to WebAssembly.
//!
//! The page writes a request as JSON into the memory that [`reserve`] gives, calls [`call`], and
//! reads the answer, JSON again, at [`answer`]. Nothing here computes dynamics: it selects what the
//! library computes, and names its errors.
//!
//! | module | what |
//! |---|---|
//! | [`machine`], [`robots`], [`import`] | a robot that is known at run time; all robots of the repository; files |
//! | [`accuracy`] | the ways to compute a torque of docs/accuracy.md |
//! | [`scene`] | scenes of `firmware-demo` that are disturbed |
//! | [`suite`] | the hard cases of `hard-case-suite` |

pub mod accuracy;
pub mod import;
pub mod machine;
pub mod request;
pub mod robots;
pub mod scene;

#[path = "../../hard-case-suite/src/lib.rs"]
#[allow(dead_code, reason = "the page uses a part of the file")]
pub mod suite;

use std::cell::RefCell;

#[derive(Default)]
struct Exchange {
    request: Vec<u8>,
    answer: Vec<u8>,
    session: request::Session,
}

thread_local! {
    static EXCHANGE: RefCell<Exchange> = RefCell::default();
}

/// Memory for a request of this many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn reserve(length: usize) -> *mut u8 {
    EXCHANGE.with_borrow_mut(|exchange| {
        exchange.request = vec![0; length];
        exchange.request.as_mut_ptr()
    })
}

/// Answers the request in the memory of [`reserve`]; returns the length of the answer in bytes.
#[unsafe(no_mangle)]
pub extern "C" fn call() -> usize {
    EXCHANGE.with_borrow_mut(|exchange| {
        let Exchange { request, session, .. } = exchange;
        let answered = request::answer(session, request);
        exchange.answer = answered;
        exchange.answer.len()
    })
}

/// The answer of the last [`call`].
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> *const u8 {
    EXCHANGE.with_borrow(|exchange| exchange.answer.as_ptr())
}
