//! User models: OBJ and glTF files read, checked, mended and scaled to fit.
