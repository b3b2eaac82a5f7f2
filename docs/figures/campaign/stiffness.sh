# Bulk and shear modulus and Z of jammed packings against pressure: linear and Hertz contacts, without and with friction, and SDEM.
document_stiffness=scenarios/stiffness/README.md
seeds_stiffness="1 2 3"

plan_stiffness() {
    local law friction seed
    for law in linear hertz; do for friction in 0 0.5; do for seed in $seeds_stiffness; do
        simulate rigid_dem "stiffness-$law-$friction-$seed" stiffness/isotropic.toml random.seed=$seed \
            rigid_dem.normal_law=$law material.friction=$friction
    done; done; done
    for seed in $seeds_stiffness; do
        simulate sdem "stiffness-sdem-0-$seed" stiffness/isotropic.toml random.seed=$seed packing.count=100
    done
}
