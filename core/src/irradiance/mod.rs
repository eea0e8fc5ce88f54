//! Unshadowed irradiance in closed form: what a diffuse receiver gets when nothing is in the way.
