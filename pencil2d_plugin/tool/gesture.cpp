#include "tool/gesture.h"

namespace lampblack
{

namespace
{
constexpr qint64 MaxPauseMs = 1000;
}

int newGesture()
{
    static int last = 0;
    return ++last;
}

int GestureSequence::gestureFor(const QString& subject)
{
    if (subject != mSubject || !mElapsed.isValid() || mElapsed.elapsed() > MaxPauseMs)
        mGesture = newGesture();
    mSubject = subject;
    mElapsed.start();
    return mGesture;
}

} // namespace lampblack
