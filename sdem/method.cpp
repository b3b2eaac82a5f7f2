#include "sdem/method.hpp"

#include <fmt/format.h>

#include <array>

#include "common/errors.hpp"
#include "sdem/solver.hpp"

namespace softgrain::sdem {

Kinematics kinematics_from(std::string_view name) {
    if (name == "D2F0") return Kinematics::D2F0;
    if (name == "D2F1") return Kinematics::D2F1;
    if (name == "D2F3") return Kinematics::D2F3;
    throw InputError(fmt::format("sdem.kinematics must be D2F0, D2F1 or D2F3, got '{}'", name));
}

namespace {

using namespace std::string_literals;

std::span<const KeySpec> keys() {
    static const std::array table{
        KeySpec{
            "law", KeyType::text, "mollon2022"s, "", "contact and stress law", any_number, {"mollon2022"}},
        KeySpec{"kinematics",
                KeyType::text,
                "D2F3"s,
                "",
                "how a grain deforms: D2F0 rigid, D2F1 volume only, D2F3 volume and shape",
                any_number,
                {"D2F0", "D2F1", "D2F3"}},
        KeySpec{"safety", KeyType::number, 0.8, "", "time step / predicted stability limit",
                Range{0.0, 1.0, true, false}},
        KeySpec{"contact_damping", KeyType::number, 1.0, "", "gamma of Mollon 2022, Eq. 61", not_negative},
        KeySpec{"shape_damping", KeyType::number, 0.5, "",
                "damping of a grain's free oscillations: gamma of Mollon 2022, Eq. 62-64, is "
                "shape_damping * sqrt(E/rho) / R in 1/s",
                not_negative},
        KeySpec{"skin", KeyType::number, 0.2, "mean radii", "reach of the neighbour list beyond the grains",
                positive},
        KeySpec{"outline_points", KeyType::integer, std::int64_t{64}, "",
                "nodes of a grain's outline in the view", Range{8.0, 4096.0}},
    };
    return table;
}

std::unique_ptr<Solver> make(const Scenario& scenario, const Packing& packing) {
    const Material& material = scenario.material;
    if (packing.size() == 0)
        throw InputError("sdem: the packing has no grain; give packing.path or packing.count");
    if (material.friction > 0.0)
        throw InputError(
            fmt::format("sdem.law = \"mollon2022\" has no friction, got material.friction = {}; set "
                        "material.friction = 0 or run another method",
                        material.friction));
    if (!(material.poisson_ratio >= 0.0 && material.poisson_ratio <= 0.5))
        throw InputError(
            fmt::format("material.poisson_ratio must be 0 to 0.5, got {}", material.poisson_ratio));
    const auto table = scenario.method_settings.find("sdem");
    const Settings settings = table == scenario.method_settings.end() ? Settings(keys()) : table->second;

    Options options;
    options.kinematics = kinematics_from(settings.text("kinematics"));
    options.incompressible = material.poisson_ratio == 0.5;
    options.safety = settings.number("safety");
    options.shape_damping = settings.number("shape_damping");
    options.skin = settings.number("skin");
    options.outline_points = static_cast<int>(settings.integer("outline_points"));
    const Mollon2022 law =
        Mollon2022::from(material.youngs_modulus, material.poisson_ratio, settings.number("contact_damping"));
    return std::make_unique<SoftDiscSolver>(material, packing, law, options);
}

}  // namespace

const Method& method() {
    static const Method row{"sdem", "SDEM: soft discs with six degrees of freedom (Mollon 2022)", keys, make,
                            ""};
    return row;
}

}  // namespace softgrain::sdem
