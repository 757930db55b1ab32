#include "worker/other_computer.h"

#include <QFileInfo>
#include <QRegularExpression>

namespace lampblack
{

OtherComputer::OtherComputer(const Computer& computer, QObject* parent)
    : WorkerSource(parent), mComputer(computer)
{
    mTimer.setSingleShot(true);
    connect(&mTimer, &QTimer::timeout, this, &OtherComputer::approach);
}

void OtherComputer::start()
{
    if (mRunning)
        return;
    mRunning = true;
    mRetries.forget();
    mTimer.start(0);
}

void OtherComputer::stop()
{
    mRunning = false;
    mTimer.stop();
}

void OtherComputer::restart(const QString& reason)
{
    if (!mRunning)
        return;
    const std::optional<int> delay = mRetries.delayAfterFailure();
    if (!delay)
    {
        UserError error = notReached();
        error.details += QLatin1Char('\n') + reason;
        giveUp(error);
        return;
    }
    Q_EMIT lost();
    mTimer.start(*delay);
}

void OtherComputer::giveUp(UserError error)
{
    stop();
    error.kind = UserError::Kind::NoOtherComputer;
    Q_EMIT gaveUp(error);
}

void OtherComputer::approach()
{
    static const QRegularExpression address(QStringLiteral("^[A-Za-z0-9._-]+:[0-9]{1,5}$"));
    if (!address.match(mComputer.address).hasMatch())
    {
        giveUp({tr("\"%1\" is no address of a computer.").arg(mComputer.address.left(80)),
                tr("Write it like 10.0.0.5:7100, under \"Render on\"."), QString()});
        return;
    }
    QString unread;
    const std::optional<CurveKeys> keys = readCurveKeys(mComputer.key, mComputer.ownKey, &unread);
    if (!keys)
    {
        giveUp({tr("%1 is no such key.").arg(QFileInfo(unread).fileName()),
                tr("Choose again under \"Render on\": the key of that computer ends in .key, yours in "
                   ".key_secret."),
                unread});
        return;
    }
    mKeys = *keys;
    Q_EMIT ready(QStringLiteral("tcp://") + mComputer.address);
}

UserError OtherComputer::versionMismatch(const QString& details) const
{
    return {tr("The other computer has another version of Lampblack."),
            tr("Install the same version on both."), details};
}

UserError OtherComputer::refused() const
{
    return {tr("The other computer does not let you in."),
            tr("Give your public key, %1, to the person who runs it. Check that you have its key.")
                .arg(QFileInfo(mComputer.ownKey).completeBaseName() + QStringLiteral(".key")),
            mComputer.address};
}

UserError OtherComputer::notReached() const
{
    return {
        tr("The other computer does not answer."),
        tr("Check that it is on, that Lampblack serves there, and its address. Or render on this computer."),
        mComputer.address};
}

} // namespace lampblack
