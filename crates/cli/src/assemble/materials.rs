//! Materials of files → shaders.
