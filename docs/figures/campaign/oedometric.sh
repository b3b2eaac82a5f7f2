# Isotropic and oedometric compaction of the same 50 grains by all methods.
document_oedometric=scenarios/oedometric/README.md

plan_oedometric() {
    local method
    for method in sdem bpm rigid_dem; do
        simulate $method "isotropic-$method" default.toml sampling.frame_every=1000
        simulate $method "oedometric-$method" oedometric/three_methods.toml sampling.frame_every=1000
    done
}
