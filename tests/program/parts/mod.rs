//! Parts of the program by themselves.

mod caches;
mod card;
mod hostile_fmus;
mod installed;
mod libm;
mod linkers;
mod messages;
mod parallel;
mod prebuilt_folders;
mod temporary;
