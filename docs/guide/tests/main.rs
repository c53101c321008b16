//! The pages and pictures of the documents, and the programs on the guide's pages.

mod circles;
mod files;
mod pages;
mod pictures;
mod reference;
mod reports;
