//! The links of the documents, and the programs on the guide's pages.

mod links;
mod pages;
mod reports;
