// uses: gather/curve, the material set

/// A profile model with its coefficients evaluated: what the functions `<model>_area_pdf` and its siblings take.
struct Profile {
    model: u32,
    coefficients: vec4f,
    /// What the model has besides, which is no function of the surface albedo.
    shape: ProfileShape,
    /// Its quantile curve.
    curve: Curve,
}

/// The profiles of the three channels at one pixel.
struct ChannelProfiles {
    red: Profile,
    green: Profile,
    blue: Profile,
}

/// The profile of one channel, by its number.
fn channel_profile(profiles: ChannelProfiles, channel: u32) -> Profile {
    switch channel {
        case 0u: {
            return profiles.red;
        }
        case 1u: {
            return profiles.green;
        }
        default: {
            return profiles.blue;
        }
    }
}
