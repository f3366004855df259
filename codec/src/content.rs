//! Content of objects and elements (COM-5, SDA-4).

use crate::bytes_stream::bytes_stream;
use crate::layout::field::content::CONTENT;
use crate::limits::ADS_DATA_MAX;

bytes_stream! {
    #[doc = include_str!("../doc/content.md")]
    ///
    /// What the bytes mean, the object's descriptor or the element's attributes say.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1.2 and 2.2.2.
    ///
    /// `decode` refuses with [`TooLong`](crate::ErrorKind::TooLong).
    ///
    /// ```
    /// use ads_cnc::{ContentRef, Decode};
    ///
    /// // feedhold.enable, a BOOLEAN
    /// assert_eq!(ContentRef::decode(&[1])?.bytes, [1]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ContentRef, Content, Content {
        /// The bytes.
        bytes: CONTENT, 0 to ADS_DATA_MAX
    }
}
