// Comparison with images enumerated one by one, with and without sliding images.
#include "core/periodicity.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace corpuscle {
namespace {

const Vec3 low(-1, 2, 0), high(3, 5, 1.5);

struct Boxed {
    std::array<bool, 3> along;
    int sliding;  // axis whose images slide; -1: none
};

class PeriodicBox : public testing::TestWithParam<Boxed> {
  protected:
    Periodicity box{low, high, GetParam().along};
    Vec3 offset = Vec3::Zero(), speed = Vec3::Zero();
    std::mt19937_64 random{7};

    void SetUp() override {
        if (GetParam().sliding < 0) return;
        offset[(GetParam().sliding + 1) % 3] = 0.7, speed[(GetParam().sliding + 1) % 3] = -3;
        box.slide(GetParam().sliding, offset, speed);
    }
    Vec3 somewhere(double reach) {
        std::uniform_real_distribution<double> number(-reach, reach);
        return {number(random), number(random), number(random)};
    }
    // All images of x, up to six periods away along each axis.
    std::vector<Periodicity::Image> images() const {
        std::vector<Periodicity::Image> all;
        const auto most = [&](int k) { return GetParam().along[static_cast<std::size_t>(k)] ? 6 : 0; };
        for (int a = -most(0); a <= most(0); ++a)
            for (int b = -most(1); b <= most(1); ++b)
                for (int c = -most(2); c <= most(2); ++c) {
                    const Vec3 n(a, b, c);
                    const double across = GetParam().sliding < 0 ? 0 : n[GetParam().sliding];
                    all.push_back({n.cwiseProduct(high - low) + across * offset, across * speed});
                    const Periodicity::Image same = box.image({a, b, c});
                    EXPECT_LT((same.shift - all.back().shift).norm(), 1e-14);
                    EXPECT_EQ(same.slide, all.back().slide);
                }
        return all;
    }
};

TEST_P(PeriodicBox, wrapsIntoTheBoxWithTheVelocityOfTheImage) {
    for (int trial = 0; trial < 80; ++trial) {
        Vec3 from = somewhere(7);
        const Vec3 velocity = somewhere(1);
        // So near a face that the result depends on rounding: offsets of 1 to 1e9 times 1e-16, on both sides.
        const double bits = std::pow(10, trial % 10) * 1e-16 * (trial % 20 < 10 ? 1 : -1);
        if (trial >= 50)
            for (int k = 0; k < 3; ++k) from[k] = (trial % 3 == k ? low[k] : high[k]) + bits;
        Vec3 x = from, u = velocity;
        box.wrap(x, u);
        EXPECT_EQ(box.wrap(from), x);
        bool isImage = false;
        for (const auto& [shift, slide] : images())
            isImage = isImage || ((from + shift - x).norm() < 1e-12 && (velocity + slide - u).norm() < 1e-12);
        EXPECT_TRUE(isImage);
        EXPECT_LT((velocity + box.slideOf(from, x) - u).norm(), 1e-12);
        for (int k = 0; k < 3; ++k) {
            if (box.isAlong(k)) {
                EXPECT_TRUE(x[k] >= low[k] && x[k] < high[k]);
            } else if (GetParam().sliding < 0) {
                EXPECT_EQ(x[k], from[k]);
            }
        }
        EXPECT_EQ(box.wrap(x), x) << "inside nothing changes, to the bit";
    }
}

TEST_P(PeriodicBox, findsAllImagesWithinACuboid) {
    for (int trial = 0; trial < 20; ++trial) {
        const Vec3 x = somewhere(3), from = somewhere(4), to = from + Vec3(2.5, 3, 4);
        std::vector<Vec3> found;
        box.forImagesWithin(x, from, to, [&](const Vec3& image) { found.push_back(image); });
        std::size_t expected = 0;
        for (const auto& [shift, slide] : images()) {
            const Vec3 image = x + shift;
            if ((image.array() < from.array()).any() || (image.array() > to.array()).any()) continue;
            ++expected;
            EXPECT_TRUE(
                std::any_of(found.begin(), found.end(), [&](const Vec3& one) { return (one - image).norm() < 1e-12; }));
        }
        EXPECT_EQ(found.size(), expected);
    }
}

TEST_P(PeriodicBox, nearestAndShortestImages) {
    for (int trial = 0; trial < 50; ++trial) {
        const Vec3 x = somewhere(5), to = somewhere(3);
        const Vec3 near = box.nearest(x, to), d = box.shortest(x - to);
        EXPECT_LT((near - to - d).norm(), 1e-12);
        bool isImage = false;
        double least = (x - to).norm();
        for (const auto& [shift, slide] : images()) {
            isImage = isImage || (x + shift - near).norm() < 1e-12;
            least = std::min(least, (x + shift - to).norm());
        }
        EXPECT_TRUE(isImage);
        if (GetParam().sliding < 0) {
            EXPECT_NEAR(d.norm(), least, 1e-12);
        }
        EXPECT_EQ(box.nearest(near, to), near);
    }
}

INSTANTIATE_TEST_SUITE_P(all, PeriodicBox,
                         testing::Values(Boxed{{true, true, true}, -1}, Boxed{{true, true, false}, -1},
                                         Boxed{{false, false, false}, -1}, Boxed{{true, true, true}, 2},
                                         Boxed{{true, true, true}, 0}, Boxed{{true, false, true}, 2}));

TEST(Periodicity, slidesAcrossAPeriodicAxisOnly) {
    Periodicity box(low, high, {true, true, false});
    EXPECT_THROW(box.slide(2, Vec3(1, 0, 0), Vec3::Zero()), std::logic_error);
    EXPECT_THROW(box.slide(0, Vec3(1, 0, 0), Vec3::Zero()), std::logic_error);
    box.slide(1, Vec3(0.5, 0, 0), Vec3(2, 0, 0));
    EXPECT_TRUE(box.slides());
}

}  // namespace
}  // namespace corpuscle
