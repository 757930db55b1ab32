#include "tool/gesture.h"

namespace lampblack
{

namespace
{
constexpr qint64 PauseMs = 1000;
}

int newGesture()
{
    static int last = 0;
    return ++last;
}

int GestureRun::of(const QString& subject)
{
    if (subject != mSubject || !mSince.isValid() || mSince.elapsed() > PauseMs)
        mGesture = newGesture();
    mSubject = subject;
    mSince.start();
    return mGesture;
}

} // namespace lampblack
