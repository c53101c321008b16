//! The links and pictures of the documents, and the programs on the guide's pages.

mod links;
mod pages;
mod pictures;
mod reference;
mod reports;
