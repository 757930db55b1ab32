#include "window/layer_reader.h"

#include "own_folder.h"
#include "worker/clean_environment.h"
#include "worker/interpreter.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QRegularExpression>
#include <QTimer>

namespace lampblack
{

namespace
{

constexpr int EndTimeoutMs = 2000;
constexpr int MaxLineBytes = 4 << 20;
constexpr int MaxErrorBytes = 4096;
constexpr int LastFrame = 999999;
constexpr int LargestSide = 16384;

UserError errorFrom(const QJsonObject& said)
{
    return {said.value(QLatin1String("what")).toString(), said.value(QLatin1String("remedy")).toString(),
            said.value(QLatin1String("details")).toString(), UserError::Kind::NotRead};
}

Shot shotFrom(const QJsonObject& said)
{
    Shot shot;
    const QJsonArray size = said.value(QLatin1String("canvas")).toArray();
    shot.canvas = {qBound(1, size.at(0).toInt(), LargestSide), qBound(1, size.at(1).toInt(), LargestSide)};
    shot.framesPerSecond = said.value(QLatin1String("fps")).toDouble(shot.framesPerSecond);
    shot.frames.first = qBound(0, said.value(QLatin1String("first")).toInt(1), LastFrame);
    shot.frames.last = qBound(shot.frames.first, said.value(QLatin1String("last")).toInt(1), LastFrame);
    const QJsonArray layers = said.value(QLatin1String("layers")).toArray();
    for (const QJsonValue& each : layers)
        shot.layers.prepend({each[QLatin1String("name")].toString(), Layer::Kind::Bitmap,
                             each[QLatin1String("visible")].toBool()});
    return shot;
}

QTransform viewFrom(const QJsonArray& affine)
{
    const auto at = [&affine](int index)
    {
        return affine.at(index).toDouble();
    };
    return affine.size() == 6 ? QTransform(at(0), at(3), at(1), at(4), at(2), at(5)) : QTransform();
}

} // namespace

bool LayeredFrame::isSame(const LayeredFrame& other) const
{
    return view == other.view && files == other.files && whole == other.whole &&
           error.has_value() == other.error.has_value();
}

LayerReader::LayerReader(QObject* parent) : QObject(parent), mFolder(ownFolderTemplate())
{
}

LayerReader::~LayerReader()
{
    const auto processes = findChildren<QProcess*>();
    for (QProcess* process : processes)
    {
        process->disconnect();
        process->kill();
        process->waitForFinished(EndTimeoutMs);
    }
}

void LayerReader::read(const QString& path, int firstFrame)
{
    give(mProcess);
    mErrors.clear();
    const Interpreter interpreter = findInterpreter();
    if (std::optional<UserError> error = whyUnusable(interpreter))
    {
        error->kind = UserError::Kind::NoWorker;
        Q_EMIT failed(*error);
        return;
    }
    if (!mFolder.isValid())
    {
        Q_EMIT failed({tr("There is no place for the pictures of the drawing."),
                       tr("Make room in %1, then open it again.").arg(QDir::tempPath()),
                       mFolder.errorString()});
        return;
    }
    mProcess = new QProcess(this);
    mProcess->setProcessEnvironment(cleanEnvironment(mFolder.path()));
    mProcess->setWorkingDirectory(mFolder.path());
    mProcess->setStandardInputFile(QProcess::nullDevice());
    connect(mProcess, &QProcess::readyReadStandardOutput, this, &LayerReader::readLines);
    connect(mProcess, &QProcess::readyReadStandardError, this,
            [this] { mErrors = (mErrors + mProcess->readAllStandardError()).right(MaxErrorBytes); });
    connect(mProcess, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), this,
            [this](int code, QProcess::ExitStatus status)
            { onEnded(status == QProcess::NormalExit ? code : -1, tr("It ended with code %1.").arg(code)); });
    connect(mProcess, &QProcess::errorOccurred, this,
            [this](QProcess::ProcessError error)
            {
                if (error == QProcess::FailedToStart)
                    onEnded(-1, mProcess->errorString());
            });
    mProcess->start(interpreter.path,
                    {QStringLiteral("-I"), QStringLiteral("-m"), QStringLiteral("lampblack"),
                     QStringLiteral("layers"), path, QStringLiteral("-o"), mFolder.path(),
                     QStringLiteral("--first"), QString::number(firstFrame)});
}

/// Let go of a process, which ends in the background.
void LayerReader::give(QProcess* process)
{
    mProcess.clear();
    if (process == nullptr)
        return;
    process->disconnect();
    connect(process, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), process,
            &QObject::deleteLater);
    QTimer::singleShot(EndTimeoutMs, process, &QProcess::kill);
    if (process->state() == QProcess::NotRunning)
        process->deleteLater();
    else
        process->terminate();
}

void LayerReader::readLines()
{
    while (mProcess && mProcess->canReadLine())
        readLine(mProcess->readLine());
    if (mProcess && mProcess->bytesAvailable() > MaxLineBytes)
        fail({tr("The renderer said something that is too long."), {}, {}, UserError::Kind::NotRead});
}

void LayerReader::readLine(const QByteArray& line)
{
    const QJsonObject said = QJsonDocument::fromJson(line).object();
    if (said.contains(QLatin1String("canvas")))
    {
        Q_EMIT shotRead(shotFrom(said));
        return;
    }
    const QJsonValue error = said.value(QLatin1String("error"));
    if (!said.contains(QLatin1String("frame")))
    {
        if (error.isObject())
            fail(errorFrom(error.toObject()));
        return;
    }
    LayeredFrame shown;
    const int frame = said.value(QLatin1String("frame")).toInt();
    shown.view = viewFrom(said.value(QLatin1String("view")).toArray());
    if (error.isObject())
    {
        shown.error = errorFrom(error.toObject());
        shown.error->frame = frame;
    }
    const QJsonObject files = said.value(QLatin1String("files")).toObject();
    for (auto file = files.begin(); file != files.end(); ++file)
        shown.files.insert(file.key(), fileIn(file.value().toString()));
    shown.whole = fileIn(said.value(QLatin1String("whole")).toString());
    Q_EMIT frameRead(frame, shown);
}

/// Empty for what is no name of a picture.
QString LayerReader::fileIn(const QString& name) const
{
    static const QRegularExpression made(QStringLiteral("^[0-9a-f]{40}\\.png$"));
    return made.match(name).hasMatch() ? mFolder.filePath(name) : QString();
}

void LayerReader::fail(const UserError& error)
{
    give(mProcess);
    Q_EMIT failed(error);
}

void LayerReader::onEnded(int code, const QString& reason)
{
    readLines();
    if (!mProcess) // it said itself why it failed
        return;
    mErrors = (mErrors + mProcess->readAllStandardError()).right(MaxErrorBytes);
    give(mProcess);
    const QString said = QString::fromUtf8(mErrors).trimmed();
    if (code == 0)
        Q_EMIT finished(said);
    else
        Q_EMIT failed({tr("The drawing could not be read."), tr("Open it again."),
                       reason + QLatin1Char('\n') + said, UserError::Kind::NotRead});
}

} // namespace lampblack
