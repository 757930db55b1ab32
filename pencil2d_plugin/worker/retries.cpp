#include "worker/retries.h"

#include <algorithm>

namespace lampblack
{

namespace
{
constexpr int DelaysMs[] = {0, 1000, 3000};
constexpr int MaxFailures = 4;
constexpr qint64 MinuteMs = 60000;
} // namespace

std::optional<int> Retries::delayAfterFailure()
{
    if (!mClock.isValid())
        mClock.start();
    const qint64 now = mClock.elapsed();
    mFailures.append(now);
    mFailures.erase(std::remove_if(mFailures.begin(), mFailures.end(),
                                   [now](qint64 failure) { return failure < now - MinuteMs; }),
                    mFailures.end());
    if (mFailures.size() >= MaxFailures)
        return std::nullopt;
    return DelaysMs[mFailures.size() - 1];
}

} // namespace lampblack
