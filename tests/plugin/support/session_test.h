// A WorkerSession with a worker process that follows a script, see fake_worker.cpp.
#pragma once

#include "worker/worker_session.h"

#include <QFile>
#include <QFileInfo>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtTest>

#include <memory>

namespace lampblack
{

constexpr int Side = 8;

inline QImage sheet(Qt::GlobalColor colour)
{
    QImage image(Side, Side, QImage::Format_RGBA8888);
    image.fill(colour);
    return image;
}

inline Scene sceneLitFrom(double x)
{
    Scene scene = defaultScene(QSize(Side, Side));
    scene.lights[0].x = x;
    return scene;
}

/// Each test has a folder of its own.
class SessionTest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        mFolder = std::make_unique<QTemporaryDir>();
        mImages.clear();
        mProblems.clear();
        qputenv("LAMPBLACK_FAKE_FOLDER", mFolder->path().toLocal8Bit());
    }

protected:
    std::unique_ptr<WorkerSession> open(const QByteArray& script)
    {
        qputenv("LAMPBLACK_FAKE", script);
        auto session = std::make_unique<WorkerSession>(
            Interpreter{QStringLiteral(LAMPBLACK_FAKE_WORKER), QStringLiteral("the test")});
        watch(*session);
        session->start();
        return session;
    }

    void watch(WorkerSession& session)
    {
        connect(&session, &Worker::imageArrived, this,
                [this](const PreviewImage& image) { mImages.append(image); });
        connect(&session, &Worker::problem, this,
                [this](const UserError& error) { mProblems.append(error); });
    }

    static void lookAtOne(WorkerSession& session)
    {
        session.putFrame(1, sheet(Qt::red));
        session.setScene(sceneLitFrom(1));
        session.requestPreview(1, Show::Lit, QRectF(0, 0, Side, Side), QSize(Side, Side));
    }

    QList<QJsonObject> received() const
    {
        QFile log(mFolder->filePath(QStringLiteral("received")));
        (void)log.open(QIODevice::ReadOnly);
        QList<QJsonObject> headers;
        const QList<QByteArray> lines = log.readAll().split('\n');
        for (const QByteArray& line : lines)
        {
            if (!line.isEmpty())
            {
                headers.append(QJsonDocument::fromJson(line).object());
            }
        }
        return headers;
    }

    int launchesCounted() const
    {
        return int(QFileInfo(mFolder->filePath(QStringLiteral("launches"))).size());
    }

    std::unique_ptr<QTemporaryDir> mFolder;
    QVector<PreviewImage> mImages;
    QVector<UserError> mProblems;
};

} // namespace lampblack
