#pragma once
// One solve of contact dynamics: which blocks and seams are relaxed when, and by which thread.
#include <array>
#include <vector>

#include "common/contact_dynamics/contact_dynamics.hpp"
#include "common/contact_dynamics/contact_rows.hpp"
#include "common/contact_dynamics/sweep.hpp"

namespace softgrain {

/// Sweeps over the blocks, shared among threads, then over the seams colour by colour. Blocks that have come
/// to rest are left out until seams push them again; the last sweep is over all of them. Every number of
/// threads makes the same sequence of operations on every disc.
class Relaxation {
  public:
    Relaxation(ContactRows& rows, WallRows& wall_rows, const ContactBlocks& blocks, const Discs& discs,
               const WallMotion& walls, double h, const ContactSettings& settings);

    ContactResult run(bool threads);

  private:
    /// What is decided after a sweep about the next one.
    struct Plan {
        bool done = false;
        bool alone = false;  ///< too little work to be shared
    };

    void start_block(int block);
    void start_seam(std::size_t seam);
    void relax_block(int block);
    void relax_seam(std::size_t seam);
    void push(int block, double change);
    Plan after_sweep();
    void choose_blocks();

    template <class OnBlock, class OnSeam>
    void sweep(int thread, int threads, OnBlock on_block, OnSeam on_seam);
    int first_choice_of(int thread, int threads) const;

    const contact_sweep::Resistance& resistance(int a, int b) const {
        const std::vector<int>& group = blocks_.group_of_block;
        return group[static_cast<std::size_t>(a)] == group[static_cast<std::size_t>(b)] ? settings_.within
                                                                                        : settings_.between;
    }

    ContactRows& rows_;
    WallRows& wall_rows_;
    const ContactBlocks& blocks_;
    const Discs& discs_;
    const WallMotion& walls_;
    const double h_;
    const ContactSettings& settings_;
    const double limit_;  ///< tolerance as a velocity [m/s]

    std::vector<char> awake_;        ///< [blocks]
    std::vector<double> pushed_;     ///< [blocks] what seams did to a resting block [m/s]
    std::vector<double> change_;     ///< [blocks, seams] largest in this sweep [m/s]; < 0 if left out
    std::vector<double> overlap_;    ///< [blocks, seams] deepest at the start [m]
    std::vector<int> chosen_;        ///< blocks of this sweep
    std::vector<int> chosen_start_;  ///< [chosen + 1] sum of the rows of the blocks before
    bool full_ = true;               ///< this sweep is over all blocks and seams
    bool stopped_ = false;
    double relaxed_rows_ = 0.0;
    ContactResult result_;
};

}  // namespace softgrain
