#include "meter/order_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace slod {
namespace {

/// Probabilities of the numbers of n values that are below their q-quantile.
class Binomial {
public:
    Binomial(double q, std::size_t n)
        : n_(double(n)), log_odds_(std::log(q / (1 - q))), log_not_(std::log1p(-q))
    {}

    double operator()(double k) const
    {
        return std::exp(log_factorial(n_) - log_factorial(k) - log_factorial(n_ - k) + k * log_odds_ +
                        n_ * log_not_);
    }

private:
    static double log_factorial(double k)
    {
        int sign = 0;
        return ::lgamma_r(k + 1, &sign); // std::lgamma writes a variable of the whole program
    }

    double n_, log_odds_, log_not_;
};

} // namespace

QuantileRanks ranks_around(double q, std::size_t n)
{
    constexpr double tail = 0.025;
    // Ten standard deviations from the mean there is nothing left of the tails.
    const double middle = q * double(n), reach = 10 * std::sqrt(middle * (1 - q)) + 10;
    const auto first = std::size_t(std::max(middle - reach, 0.0));
    const auto last = std::min(std::size_t(middle + reach), n);
    const Binomial probability(q, n);
    QuantileRanks ranks{first, n - 1};
    double below = 0; // that k or fewer are
    for (std::size_t k = first; k + 1 < n && (below += probability(double(k))) <= tail; ++k)
        ranks.low = k;
    double above = 0; // that k or more are
    for (std::size_t k = last; k > ranks.low + 1 && (above += probability(double(k))) <= tail; --k)
        ranks.high = k - 1;
    return ranks;
}

} // namespace slod
