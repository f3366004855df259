"""The negative control: a crate that exposes the types and the trait of another crate in many ways. The check
must report each of them."""

import pathlib
import re
import tempfile

STRANGER = """
pub struct Thing;
pub trait Trait { type Out; fn act(&self) {} }
"""

# Each item whose name begins with `bad`, `Bad` or `BAD` exposes the crate `stranger`, and so does the impl for
# `stranger::Thing`. The items whose names begin with `good` or `Good` use that crate privately or not at all.
LEAKS = """
#![no_std]
pub use stranger::Thing as bad_use;
pub mod bad_glob { pub use stranger::*; }
pub struct BadField { pub bad: stranger::Thing, good: stranger::Thing }
pub struct BadTuple(pub stranger::Thing);
pub enum BadVariant { Bad(stranger::Thing), Good }
pub enum BadNamed { Bad { bad: stranger::Thing } }
pub fn bad_argument(_: &[stranger::Thing]) {}
pub fn bad_result() -> Result<Option<(u8, stranger::Thing)>, ()> { Err(()) }
pub fn bad_bound<T: stranger::Trait>(_: T) {}
pub fn bad_where<T>(_: T) where T: stranger::Trait {}
pub fn bad_impl() -> impl Iterator<Item = stranger::Thing> { None.into_iter() }
pub fn bad_pointer(_: fn(stranger::Thing)) {}
pub const BAD_CONST: Option<stranger::Thing> = None;
pub type BadAlias = stranger::Thing;
pub trait BadSuper: stranger::Trait {}
pub trait BadItem { type Bad: stranger::Trait; fn bad(&self, _: &dyn stranger::Trait<Out = u8>); }
pub struct BadMethod;
impl BadMethod { pub fn bad(&self) -> stranger::Thing { stranger::Thing } }
pub struct BadDerive;
impl stranger::Trait for BadDerive { type Out = (); }
pub struct BadFrom;
impl From<stranger::Thing> for BadFrom { fn from(_: stranger::Thing) -> Self { Self } }
pub struct BadOut;
impl Iterator for BadOut {
    type Item = stranger::Thing;
    fn next(&mut self) -> Option<stranger::Thing> { None }
}
pub struct Into;
impl From<Into> for stranger::Thing { fn from(_: Into) -> Self { Self } }
#[doc(hidden)]
pub fn bad_hidden() -> stranger::Thing { stranger::Thing }

mod private { pub struct GoodPrivate(pub stranger::Thing); impl stranger::Trait for GoodPrivate { type Out = (); } }
pub struct Good(private::GoodPrivate);
impl Good { fn good(&self) -> &stranger::Thing { &self.0.0 } }
"""


def strangers(run, read, options):
    """The public items in which the check finds types of other crates, and those in which it must find them."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "stranger.rs").write_text(STRANGER)
        (folder / "leaks.rs").write_text(LEAKS)
        library = ["--edition=2024", "--crate-type=lib"]
        run(["rustc", *library, "stranger.rs"], folder)
        run(["rustdoc", *library, "--extern=stranger=libstranger.rlib", "--crate-name=leaks", "leaks.rs", *options], folder)
        shown = read(folder / "doc" / "leaks.json").strangers
    found = {re.split("[:<]", place)[0] for place, _ in shown}
    declared = re.findall(r"(?:pub|Thing as) (?:[a-z]+ )?(\w+)", LEAKS)
    bad = {name for name in declared if re.match("bad_|BAD_|Bad[A-Z]", name)}
    # An impl for `stranger::Thing` is reported under the name of this type.
    return found, bad | {"Thing"}
