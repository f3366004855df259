//! Content of objects and elements.

use crate::declare::stream;

stream! {
    /// The content of an object or of an element.
    ///
    /// The descriptor of the object, or the attributes of the element, determine the type.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1.2 and 2.2.2.
    ///
    /// `decode` can fail with [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{ContentRef, Decode};
    ///
    /// // The content of feedhold.enable, a BOOLEAN.
    /// assert_eq!(ContentRef::decode(&[1])?.bytes, [1]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    Content "content", "Content of an object or element", "COM-5", max ADS_DATA;
    struct ContentRef<'a> / Content {
        @0 bytes "content": REST(0, ADS_DATA), "COM-5", "as descriptor or attributes say";
    }
}
